// Links that are bodies: right where the recording is good, bodies where least squares has none, frictions that brake.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.hpp"
#include "engine/fit/problem/arm_regression.hpp"
#include "engine/fit/problem/estimator.hpp"
#include "engine/robot/consistency.hpp"
#include "engine/robot/pseudo_inertia.hpp"
#include "support/decompositions.hpp"
#include "unit/problem/arm_data.hpp"
#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace consistent_test {

using Eigen::Index;
using namespace test;

// the arm, and as a file has it whose links are a third too heavy
ArmModel near_wrong_file() {
  auto chain = crs_chain();
  for (auto& link : chain.links) link = LinkInertia::from_vector(1.33 * link.vector());
  return {chain, {friction}, Section{"model", {}, {}}};
}

ArmModel without_inertias() {
  auto chain = crs_chain();
  chain.links.clear();
  return {chain, {friction}, Section{"model", {}, {}}};
}

// rows over the noise that is stated; noise_share: of it that is there
RegressionData recorded(ArmModel const& model, Index n, double noise_share, std::uint32_t draw, double stated = 1.0) {
  auto motion = motion_of(5, n, draw);
  add_torque(crs_chain(), motion);
  auto const clean = motion;
  add_noise(motion, draw);
  for (std::size_t j = 0; j < 5; ++j)
    motion[j].torque = clean[j].torque + noise_share * (motion[j].torque - clean[j].torque);
  Eigen::VectorXd const scale = stated * Eigen::Map<Eigen::VectorXd const>(joint_noise.data(), 5);
  return stack_rows(std::vector{rows_of(model, motion)}, ArmRowChoice::moving, model, scale, Section{"filter", {}, {}});
}

LeastSquaresFit fitted(std::string const& name, RegressionData const& data, double weight = 1.0) {
  std::vector<Problem> problems;
  Section section{"estimator", {}, {}};
  if (name == "consistent") section.settings.push_back({"prior_weight", weight, {}});
  return find_estimator(name)->prepare(section, {}, problems)(data);
}

void expect_bodies(LeastSquaresFit const& fit) {
  ASSERT_EQ(fit.standard.values.size(), 55);
  for (Index i = 0; i < 5; ++i)
    EXPECT_TRUE(is_positive_definite(pseudo_inertia(fit.standard.values.segment<10>(10 * i)))) << i;
  EXPECT_GT(fit.standard.values.tail(5).minCoeff(), 0.0);
}

// standard errors between these base parameters and the closest that bodies have
double distance_of_bodies(ArmModel const& model, LeastSquaresFit const& fit) {
  Index const p = model.base().size();
  auto const found =
      consistent_parameters(model.chain(), model.base(),
                            {fit.parameters.head(p), test::information_root(fit.covariance_naive.topLeftCorner(p, p))});
  return found.distance;
}

TEST(ConsistentFit, FindsTheArmOfAGoodRecordingWhateverItsFileSays) {
  for (auto const& model : {near_wrong_file(), without_inertias()}) {
    auto const fit = fitted("consistent", recorded(model, 1500, 0.0, 3, 1e-4));
    EXPECT_TRUE(fit.converged);
    expect_bodies(fit);
    Eigen::VectorXd const truth = model.base().from_standard(standard_parameters(crs_chain(), DriveInertias::included));
    EXPECT_LT((fit.parameters.head(truth.size()) - truth).norm(), 1e-5 * truth.norm());
    EXPECT_LT((model.base().from_standard(fit.standard.values) - fit.parameters.head(truth.size())).norm(), 1e-12);
    auto const names = model.names();
    auto const value = [&](char const* name) {
      return fit.parameters[std::find(names.begin(), names.end(), name) - names.begin()];
    };
    EXPECT_NEAR(value("viscous_2"), 0.35, 1e-4);
    EXPECT_NEAR(value("offset_3"), -0.3, 1e-4);
  }
}

TEST(ConsistentFit, OfAShortNoisyRecordingIsOfBodiesAndPredictsBetterThanLeastSquares) {
  auto const model = near_wrong_file();
  int impossible = 0;
  double wls_error = 0.0, our_error = 0.0;
  for (std::uint32_t draw = 20; draw < 28; ++draw) {
    auto const data = recorded(model, 70, 2.0, draw), validation = recorded(model, 400, 0.0, draw + 100);
    auto const wls = fitted("wls", data), ours = fitted("consistent", data);
    expect_bodies(ours);
    impossible += distance_of_bodies(model, wls) > 1.0;
    wls_error += (validation.tau - validation.phi * wls.parameters).norm();
    our_error += (validation.tau - validation.phi * ours.parameters).norm();
  }
  EXPECT_GE(impossible, 6);
  EXPECT_LT(our_error, wls_error);
}

TEST(ConsistentFit, HasNoFrictionThatPushes) {
  auto const model = near_wrong_file();
  auto data = recorded(model, 200, 1.0, 5);
  Index viscous = 0;
  auto const names = model.names();
  while (names[static_cast<std::size_t>(viscous)] != "viscous_4") ++viscous;
  data.tau -= 1.2 * data.phi.col(viscous);  // more than the joint has
  EXPECT_LT(fitted("wls", data).parameters[viscous], 0.0);
  auto const fit = fitted("consistent", data);
  EXPECT_GT(fit.parameters[viscous], 0.0);
  EXPECT_LT(fit.parameters[viscous], 3.0 * fit.standard_error[viscous]);
}

// of what may have any value nothing is left in the residual
TEST(ConsistentFit, SolvesForOffsets) {
  auto const model = near_wrong_file();
  auto const data = recorded(model, 70, 2.0, 21);
  auto const fit = fitted("consistent", data);
  Eigen::VectorXd const residual = data.tau - data.phi * fit.parameters;
  auto const names = model.names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!names[k].starts_with("offset")) continue;
    auto const column = data.phi.col(static_cast<Index>(k));
    EXPECT_LT(std::abs(column.dot(residual)), 1e-8 * column.norm() * residual.norm());
  }
}

TEST(ConsistentFit, NearsItsFileByWeight) {
  auto const model = near_wrong_file();
  auto const data = recorded(model, 200, 1.0, 6);
  Eigen::VectorXd const file = standard_parameters(model.chain(), DriveInertias::included);
  double before = 1e300;
  for (double const weight : {1e-2, 1.0, 1e4, 1e6}) {
    double sum = 0.0;
    Eigen::VectorXd const found = fitted("consistent", data, weight).standard.values;
    for (Index i = 0; i < 5; ++i)
      sum += divergence(pseudo_inertia(found.segment<10>(10 * i)), pseudo_inertia(file.segment<10>(10 * i)));
    EXPECT_LT(sum, before) << weight;
    before = sum;
  }
  EXPECT_LT(before, 0.05);
}

TEST(ConsistentFit, IsOfArms) { EXPECT_THROW(fitted("consistent", seed_data(20.0, 0.002)), Error); }

}  // namespace consistent_test
}  // namespace torquescope
