// Drive gains that are wrong, and a payload that was weighed: total least squares finds both, and says how well.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.hpp"
#include "engine/fit/problem/arm_regression.hpp"
#include "engine/fit/problem/estimator.hpp"
#include "unit/problem/arm_data.hpp"

namespace torquescope {
namespace arm_gains_test {

using namespace test;

// true gain over the stated one, less 1
std::vector<double> const gain_errors{0.12, -0.08, 0.05, -0.15, 0.1};
// 4 kg, 0.05 m beside the last frame, 0.08 m in front of it: 0.2 m long
LinkInertia load() {
  double const m = 4.0;
  Eigen::Vector3d const at(0.05, -0.02, 0.08);
  LinkVector numbers;
  numbers << m, m * at.x(), m * at.y(), m * at.z(), 0.04 + m * (at.y() * at.y() + at.z() * at.z()),
      -m * at.x() * at.y(), -m * at.x() * at.z(), 0.03 + m * (at.x() * at.x() + at.z() * at.z()), -m * at.y() * at.z(),
      0.02 + m * (at.x() * at.x() + at.y() * at.y());
  return LinkInertia::from_vector(numbers);
}

ArmModel model_with_gains(Payload const& payload = {4.0}) {
  return crs({.friction = test::friction, .payloads = {payload}, .drive_gains = true});
}

// without, and with the load; as a drive of another gain shows it
RegressionData recorded(ArmModel const& model, double noise_share, std::uint32_t draw) {
  std::vector<RecordedRows> recordings;
  for (bool const is_loaded : {false, true}) {
    SerialChain chain = model.chain();
    if (is_loaded) chain.links.back() = chain.links.back() + load();
    auto motion = motion_of(5, 700, is_loaded ? 12 : 11);
    add_torque(chain, motion);
    auto const clean = motion;
    add_noise(motion, draw + (is_loaded ? 1000 : 0));
    for (std::size_t j = 0; j < motion.size(); ++j)
      motion[j].torque =
          (clean[j].torque + noise_share * (motion[j].torque - clean[j].torque)) / (1.0 + gain_errors[j]);
    recordings.push_back(rows_of(model, motion, is_loaded ? std::optional<std::size_t>(0) : std::nullopt));
  }
  Eigen::VectorXd const scale = Eigen::Map<Eigen::VectorXd const>(test::joint_noise.data(), 5);
  return stack_rows(recordings, ArmRowChoice::moving, model, scale, Section{"filter", {}, {}});
}

LeastSquaresFit fit(char const* name, RegressionData const& data) {
  std::vector<Problem> problems;
  return find_estimator(name)->prepare({}, {}, problems)(data);
}

TEST(ArmGains, AreExactWithoutNoise) {
  auto const model = model_with_gains();
  auto const found = fit("tls", recorded(model, 0.0, 1)).parameters;
  for (std::size_t j = 0; j < 5; ++j) EXPECT_NEAR(found[model.gain_columns()[j]], gain_errors[j], 1e-8);
  Eigen::VectorXd const base = model.base().from_standard(standard_parameters(model.chain(), DriveInertias::included));
  for (Eigen::Index k = 0; k < base.size(); ++k) EXPECT_NEAR(found[k], base[k], 1e-7);
  // the load about the last frame
  auto const names = model.names();
  auto const value = [&](char const* name) {
    return found[std::find(names.begin(), names.end(), name) - names.begin()];
  };
  EXPECT_NEAR(value("payload1_mx5"), 4.0 * 0.05, 1e-7);
  EXPECT_NEAR(value("payload1_zz5"), load().vector()[9], 1e-7);
}

TEST(ArmGains, KnownFirstMomentsAreNoParameters) {
  auto const unknown = model_with_gains(), known = model_with_gains({4.0, Eigen::Vector3d(0.2, -0.08, 0.32)});
  EXPECT_EQ(unknown.size(), known.size() + 3);
  auto const found = fit("tls", recorded(known, 0.0, 1)).parameters;
  for (std::size_t j = 0; j < 5; ++j) EXPECT_NEAR(found[known.gain_columns()[j]], gain_errors[j], 1e-8);
}

// Noise as large as a fifth of the torque pulls the gains of least squares down: the torque that is scaled has it too
TEST(ArmGains, LeastSquaresIsBiasedAndTotalLeastSquaresIsNot) {
  auto const model = model_with_gains();
  constexpr int draws = 30;
  constexpr double noise_share = 6.0;
  Eigen::VectorXd plain = Eigen::VectorXd::Zero(5), total = Eigen::VectorXd::Zero(5), errors = plain;
  int held = 0;
  for (int draw = 0; draw < draws; ++draw) {
    auto const data = recorded(model, noise_share, 100 + static_cast<std::uint32_t>(draw));
    auto const wls = fit("wls", data), tls = fit("tls", data);
    for (Eigen::Index j = 0; j < 5; ++j) {
      auto const at = model.gain_columns()[static_cast<std::size_t>(j)];
      double const truth = gain_errors[static_cast<std::size_t>(j)];
      plain[j] += (wls.parameters[at] - truth) / draws;
      total[j] += (tls.parameters[at] - truth) / draws;
      errors[j] += tls.standard_error[at] / draws;
      held += tls.ci95(at, 0) <= truth && truth <= tls.ci95(at, 1);
    }
  }
  Eigen::VectorXd const of_mean = errors / std::sqrt(static_cast<double>(draws));
  for (Eigen::Index j = 0; j < 5; ++j) EXPECT_LT(std::abs(total[j]), 4.0 * of_mean[j]) << j;
  EXPECT_GT((plain.array().abs() / of_mean.array()).maxCoeff(), 10.0);
  EXPECT_GT(static_cast<double>(held) / (5.0 * draws), 0.88);
}

std::string refusal(RegressionData const& data) {
  try {
    fit("tls", data);
  } catch (Error const& error) {
    return error.problems().front().what + " | " + error.problems().front().help;
  }
  return "";
}

// the load as light as a screw: noise says what the gain is, and no sign is wrong
TEST(ArmGains, OfALoadTooLightAreRefusedByThatName) {
  auto const model = model_with_gains({0.002});
  std::vector<RecordedRows> recordings;
  for (bool const is_loaded : {false, true}) {
    auto motion = motion_of(5, 700, is_loaded ? 12 : 11);
    add_torque(model.chain(), motion);
    add_noise(motion, is_loaded ? 3 : 4);
    recordings.push_back(rows_of(model, motion, is_loaded ? std::optional<std::size_t>(0) : std::nullopt));
  }
  Eigen::VectorXd const scale = Eigen::Map<Eigen::VectorXd const>(test::joint_noise.data(), 5);
  auto const told = refusal(stack_rows(recordings, ArmRowChoice::moving, model, scale, Section{"filter", {}, {}}));
  EXPECT_NE(told.find("the payload does not tell the gain"), std::string::npos) << told;
  EXPECT_EQ(told.find("torque_per_unit"), std::string::npos) << told;
}

TEST(ArmGains, OfATurnedTorqueAreRefusedByItsSign) {
  auto data = recorded(model_with_gains(), 1.0, 1);
  for (std::size_t k = 0; k < data.recordings(); ++k) {
    if (data.arm->joint[k] != 2) continue;
    auto const first = data.first_row[k], count = data.first_row[k + 1] - first;
    data.tau.segment(first, count) *= -1.0;
    data.phi.col(data.arm->gain_column[2]).segment(first, count) *= -1.0;
  }
  auto const told = refusal(data);
  EXPECT_NE(told.find("torque of joint 3 has the other sign"), std::string::npos) << told;
}

TEST(ArmGains, AsStatedAreRowsWithoutThem) {
  auto const data = recorded(model_with_gains(), 1.0, 1);
  auto const stated = with_stated_gains(data);
  EXPECT_EQ(stated.parameters() + 5, data.parameters());
  EXPECT_EQ(stated.phi, data.phi.leftCols(stated.parameters()));
  EXPECT_EQ(stated.columns.size(), static_cast<std::size_t>(stated.parameters()));
  EXPECT_TRUE(stated.arm->gain_column.empty());
}

TEST(ArmGains, WithoutAPayloadAreNoQuestion) {
  EXPECT_THROW(fit("tls", stack_rows(std::vector<RecordedRows>{rows_of(crs(), motion_of(5, 300, 1))},
                                     ArmRowChoice::moving, crs(), Eigen::VectorXd::Ones(5), Section{"filter", {}, {}})),
               Error);
}

TEST(PayloadColumns, OfOneJointTellNoMass) {
  auto chain = crs_chain();
  chain.joints.resize(1);
  chain.links.resize(1);
  BaseParameters const base(chain, DriveInertias::left_out);
  auto const columns = payload_columns(chain, base, {4.0});
  EXPECT_FALSE(columns.tells_scale);
  EXPECT_EQ(columns.names.size(), static_cast<std::size_t>(base.size()));
}

}  // namespace arm_gains_test
}  // namespace torquescope
