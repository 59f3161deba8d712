// Rows of a simulated arm: its torques, the pooled weighted fit against stacked least squares, noise levels, intervals.

#include "engine/fit/problem/arm_regression.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/fit/problem/arm_accuracy.hpp"
#include "engine/fit/problem/estimator.hpp"
#include "engine/fit/problem/filtered_grams.hpp"
#include "support/decompositions.hpp"
#include "unit/problem/arm_data.hpp"

namespace torquescope {
namespace arm_regression_test {

using namespace test;

std::vector<RecordedRows> noisy_recordings(ArmModel const& model) {
  std::vector<RecordedRows> recordings;
  for (std::uint32_t draw : {1u, 2u}) {
    auto motion = motion_of(model.joints(), 900, draw);
    add_torque(model.chain(), motion);
    add_noise(motion, draw);
    recordings.push_back(rows_of(model, motion));
  }
  return recordings;
}

RegressionData stacked(std::vector<RecordedRows> const& recordings, ArmModel const& model,
                       Eigen::VectorXd const& scale) {
  return stack_rows(recordings, ArmRowChoice::moving, model, scale, Section{"filter", {}, {}});
}

Eigen::VectorXd estimate(char const* name, RegressionData const& data) {
  std::vector<Problem> problems;
  return find_estimator(name)->prepare({}, {}, problems)(data).parameters;
}

// every row of every joint below each other, of full width, divided by scale
struct Dense {
  Eigen::MatrixXd columns;
  Eigen::VectorXd torque;
};
Dense dense(std::vector<RecordedRows> const& recordings, ArmModel const& model, Eigen::VectorXd const& scale) {
  Dense all;
  for (auto const& recording : recordings)
    for (std::size_t j = 0; j < model.joints(); ++j) {
      auto const& rows = recording.moving[j];
      Eigen::Index const n = rows.torque.size(), before = all.torque.size();
      all.columns.conservativeResize(before + n, static_cast<Eigen::Index>(model.size()));
      all.torque.conservativeResize(before + n);
      all.columns.bottomRows(n).setZero();
      for (std::size_t c = 0; c < model.parameters_of(j).size(); ++c)
        all.columns.col(model.parameters_of(j)[c]).tail(n) =
            rows.columns.col(static_cast<Eigen::Index>(c)) / scale[static_cast<Eigen::Index>(j)];
      all.torque.tail(n) = rows.torque / scale[static_cast<Eigen::Index>(j)];
    }
  return all;
}

TEST(ArmModel, HasTheParametersOfFiveJoints) {
  auto const model = crs();
  EXPECT_EQ(model.base().size(), 32);  // Gautier and Khalil 1990: 28 of five links, four drives
  EXPECT_EQ(model.size(), 47u);
  auto const names = model.names();
  EXPECT_EQ(names.back(), "offset_5");
  EXPECT_EQ(model.parameters_of(4).back(), static_cast<Eigen::Index>(model.size()) - 1);
  // the last joint's rows know its own link alone
  EXPECT_LT(model.parameters_of(4).size(), model.parameters_of(0).size());
}

TEST(ArmRegression, FindsTheParametersOfNoiseFreeTorques) {
  auto const model = crs();
  auto motion = motion_of(5, 900, 1);
  add_torque(model.chain(), motion);
  std::vector<RecordedRows> const recordings{rows_of(model, motion)};
  Eigen::VectorXd const found = estimate("wls", stacked(recordings, model, Eigen::VectorXd::Ones(5)));
  Eigen::VectorXd const base = model.base().from_standard(standard_parameters(model.chain(), DriveInertias::included));
  for (Eigen::Index k = 0; k < base.size(); ++k)
    EXPECT_NEAR(found[k], base[k], 1e-9) << model.names()[static_cast<std::size_t>(k)];
  auto const names = model.names();
  auto const value = [&](char const* name) {
    return found[std::find(names.begin(), names.end(), name) - names.begin()];
  };
  EXPECT_NEAR(value("viscous_2"), 0.35, 1e-9);
  EXPECT_NEAR(value("coulomb_5"), 0.22, 1e-9);
  EXPECT_NEAR(value("offset_3"), -0.3, 1e-9);
}

TEST(ArmRegression, IsStackedLeastSquaresOfWeightedRows) {
  auto const model = crs();
  auto const recordings = noisy_recordings(model);
  Eigen::VectorXd scale(5);
  scale << 0.5, 1.0, 0.2, 0.07, 0.03;
  auto const data = stacked(recordings, model, scale);
  auto const weighted = dense(recordings, model, scale), plain = dense(recordings, model, Eigen::VectorXd::Ones(5));
  Eigen::VectorXd const expected = test::least_squares(weighted.columns, weighted.torque);
  EXPECT_LT((estimate("wls", data) - expected).norm(), 1e-10 * expected.norm());
  Eigen::VectorXd const unweighted = test::least_squares(plain.columns, plain.torque);
  EXPECT_LT((estimate("ols", data) - unweighted).norm(), 1e-10 * unweighted.norm());
  EXPECT_GT((expected - unweighted).norm(), 1e-4);
}

TEST(FilteredGrams, GiveResidualsAndNoiseLevels) {
  auto const model = crs();
  auto const recordings = noisy_recordings(model);
  auto const grams = filtered_grams(recordings, model);
  auto const levels = noise_levels(grams, static_cast<Eigen::Index>(model.size()));
  EXPECT_TRUE(levels.converged);
  for (std::size_t j = 0; j < 5; ++j)
    EXPECT_NEAR(levels.deviation[static_cast<Eigen::Index>(j)], joint_noise[j], 0.05 * joint_noise[j]);

  auto const data = stacked(recordings, model, levels.deviation);
  Eigen::VectorXd const found = estimate("wls", data);
  auto const accuracy = arm_accuracy(data, data, found);
  for (std::size_t j = 0; j < 5; ++j) {
    double const direct = accuracy.joints[j].residual_energy;
    EXPECT_NEAR(grams[j].residual_energy(found), direct, 1e-8 * grams[j].torque_energy());
    // the weights belong to the fit they led to
    EXPECT_NEAR(std::sqrt(direct / static_cast<double>(grams[j].rows)), levels.deviation[static_cast<Eigen::Index>(j)],
                1e-5 * levels.deviation[static_cast<Eigen::Index>(j)]);
  }
}

TEST(FilteredGrams, WithoutNoiseNoJointOutweighsTheOthersBeyondBounds) {
  auto const model = crs();
  auto motion = motion_of(5, 900, 1);
  add_torque(model.chain(), motion);
  std::vector<RecordedRows> const recordings{rows_of(model, motion)};
  auto const grams = filtered_grams(recordings, model);
  auto const levels = noise_levels(grams, static_cast<Eigen::Index>(model.size()));
  for (std::size_t j = 0; j < 5; ++j)
    EXPECT_GE(levels.deviation[static_cast<Eigen::Index>(j)],
              0.99e-6 * std::sqrt(grams[j].torque_energy() / static_cast<double>(grams[j].rows)));
}

TEST(RecordedRows, NearReversalsAreCountedAndNotFitted) {
  auto const model = crs();
  auto motion = motion_of(5, 900, 1);
  add_torque(model.chain(), motion);
  auto moves = all_move(motion);
  for (std::size_t i = 100; i < 200; ++i) moves[2][i] = false;
  motion[0].left_out = {{0.0, 0.5}};
  auto const rows = make_recorded_rows("x.csv", motion, moves, {.edge_s = 0.0}, model, Section{"filter", {}, {}});
  EXPECT_EQ(rows.others[2].torque.size(), 100);
  EXPECT_EQ(rows.others[2].instant.front(), 100);
  // what one joint leaves out nobody fits: its motion is in every row
  for (std::size_t j = 0; j < 5; ++j) EXPECT_GE(rows.moving[j].instant.front(), 25) << j;
  EXPECT_EQ(rows.moving[0].torque.size(), rows.moving[2].torque.size() + 100);
}

// Noise that all joints share, u_t s_j: the covariance of the fit is B (sum of g_t g_t') B with g_t the sum of the
// joints' rows at t, and not B, which is that of independent rows
TEST(ArmRegression, StandardErrorsKnowThatJointsShareNoise) {
  auto const model = crs();
  auto clean = motion_of(5, 500, 3);
  add_torque(model.chain(), clean);
  Eigen::VectorXd const scale = Eigen::Map<Eigen::VectorXd const>(joint_noise.data(), 5);
  std::vector<Problem> problems;
  Section const white{"estimator", {}, {{"hac_lags", std::int64_t{0}}}};
  auto const fit_wls = find_estimator("wls")->prepare(white, {}, problems);
  ASSERT_TRUE(problems.empty());
  constexpr std::uint32_t draws = 20;
  Eigen::VectorXd claimed = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.size()));
  RegressionData data;
  for (std::uint32_t draw = 0; draw < draws; ++draw) {
    auto motion = clean;
    add_noise(motion, 100 + draw, 1.0);
    data = stacked({rows_of(model, motion)}, model, scale);
    claimed += fit_wls(data).covariance_hac.diagonal() / draws;
  }
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(500, data.parameters());
  for (Eigen::Index t = 0; t < data.rows(); ++t) sums.row(t % 500) += data.phi.row(t);
  Eigen::MatrixXd const bread = inverse_information(data, {});
  Eigen::VectorXd const truth = (bread * (sums.transpose() * sums) * bread).diagonal();
  double farthest_from_independent = 0.0;
  for (Eigen::Index k = 0; k < truth.size(); ++k) {
    EXPECT_NEAR(claimed[k] / truth[k], 1.0, 0.25) << model.names()[static_cast<std::size_t>(k)];
    farthest_from_independent = std::max(farthest_from_independent, std::abs(bread(k, k) / truth[k] - 1.0));
  }
  EXPECT_GT(farthest_from_independent, 0.5);
}

TEST(ArmRegression, IntervalsHold) {
  auto const model = crs();
  Eigen::VectorXd const base = model.base().from_standard(standard_parameters(model.chain(), DriveInertias::included));
  auto clean = motion_of(5, 500, 3);
  add_torque(model.chain(), clean);
  Eigen::VectorXd const scale = Eigen::Map<Eigen::VectorXd const>(joint_noise.data(), 5);
  int held = 0, counted = 0;
  std::vector<Problem> problems;
  auto const fit_wls = find_estimator("wls")->prepare({}, {}, problems);
  for (std::uint32_t draw = 0; draw < 60; ++draw) {
    auto motion = clean;
    add_noise(motion, 100 + draw, 0.5);
    auto const fit = fit_wls(stacked({rows_of(model, motion)}, model, scale));
    for (Eigen::Index k = 0; k < base.size(); ++k, ++counted)
      held += fit.ci95(k, 0) <= base[k] && base[k] <= fit.ci95(k, 1);
  }
  double const share = static_cast<double>(held) / counted;
  EXPECT_GT(share, 0.91);
  EXPECT_LT(share, 0.98);
}

}  // namespace arm_regression_test
}  // namespace torquescope
