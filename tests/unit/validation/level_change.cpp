// Another level of friction in a recording that was predicted: told with its size where it is there, and nowhere else.

#include "engine/infer/validation/level_change.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace level_change_test {

constexpr Eigen::Index rows = 1500, memory = 20;
constexpr double least_fall = 0.05;

TorqueTrace moved(bool both_ways) {
  TorqueTrace trace;
  trace.recording = "tuesday.csv";
  trace.velocity.resize(rows);
  trace.torque.resize(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    double const t = 0.01 * static_cast<double>(i);
    trace.velocity[i] = both_ways ? std::sin(2.1 * t) : 1.5 + std::sin(2.1 * t);
    trace.torque[i] = 4.0 * std::sin(1.3 * t) + 2.0;
  }
  return trace;
}

Eigen::VectorXd noise(std::uint32_t set) {
  RandomStream random({97, set, RandomDomain::test}, 0, 0);
  Eigen::VectorXd left(rows);
  for (double& value : left) value = 0.1 * random.normal();
  return left;
}

TEST(LevelChange, IsToldWithItsSize) {
  TorqueTrace const trace = moved(true);
  Eigen::VectorXd residual = noise(1) - 0.2 * trace.velocity.array().sign().matrix();
  residual[7] = std::nan("");  // a row that the model drops
  auto const change = level_change(trace, residual, memory, least_fall);
  ASSERT_TRUE(change.has_value());
  EXPECT_TRUE(change->goes_both_ways);
  EXPECT_NEAR(change->level, -0.2, 0.01);
  EXPECT_NEAR(change->relerr_with / change->relerr_before, 0.1 / std::hypot(0.1, 0.2), 0.03);
}

TEST(LevelChange, IsNoneOfNoiseOffsetOrAnotherLaw) {
  TorqueTrace const trace = moved(true);
  for (std::uint32_t set = 2; set < 22; ++set)
    EXPECT_FALSE(level_change(trace, noise(set), memory, least_fall).has_value()) << set;
  Eigen::VectorXd const shifted = noise(30).array() + 0.3;
  EXPECT_FALSE(level_change(trace, shifted, memory, least_fall).has_value());
  Eigen::VectorXd const wave = noise(31).array() + 0.3 * (3.0 * Eigen::ArrayXd::LinSpaced(rows, 0.0, 15.0)).cos();
  EXPECT_FALSE(level_change(trace, wave, memory, least_fall).has_value());
}

TEST(LevelChange, InOneDirectionIsFrictionOrOffset) {
  TorqueTrace const trace = moved(false);
  Eigen::VectorXd const residual = noise(40).array() - 0.03 * 10.0;
  auto const change = level_change(trace, residual, memory, least_fall);
  ASSERT_TRUE(change.has_value());
  EXPECT_FALSE(change->goes_both_ways);
  EXPECT_NEAR(change->level, -0.3, 0.01);
}

TEST(LevelChange, IsNotAskedOfAFewRows) {
  TorqueTrace trace = moved(true);
  Eigen::VectorXd residual = Eigen::VectorXd::Constant(rows, std::nan(""));
  residual.head(99) = trace.velocity.head(99);
  EXPECT_FALSE(level_change(trace, residual, memory, least_fall).has_value());
}

}  // namespace level_change_test
}  // namespace torquescope
