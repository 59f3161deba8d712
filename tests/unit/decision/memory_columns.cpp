// A load on a spring and a slow mean of the speed are what their equations say, on a motion in closed form.

#include "engine/infer/decision/memory_columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "unit/decision/largest_correction.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace memory_columns_test {

// torque of a load on a spring that the joint carries, by midpoints of a hundredth of a sample
std::function<double(double t)> load_torque(GivenJoint const& joint, double frequency_hz, double inertia) {
  double const omega = 2.0 * std::numbers::pi * frequency_hz, damping = 0.05, step_s = 5e-5;
  auto values = std::make_shared<std::vector<double>>();
  double apart = 0.0, speed = 0.0;
  auto const change = [&](double t, double x, double v) {
    return instant_of(joint, t).ddq - omega * omega * x - 2.0 * damping * omega * v;
  };
  for (int k = 0; k <= 400000; ++k) {
    values->push_back(inertia * (omega * omega * apart + 2.0 * damping * omega * speed));
    double const t = k * step_s, middle_x = apart + 0.5 * step_s * speed,
                 middle_v = speed + 0.5 * step_s * change(t, apart, speed);
    apart += step_s * middle_v;
    speed += step_s * change(t + 0.5 * step_s, middle_x, middle_v);
  }
  return [values](double t) { return (*values)[static_cast<std::size_t>(std::max(0.0, t) / 5e-5)]; };
}

TEST(MemoryColumns, AtConstantSpeedTheMeanIsTheSpeedAndNoLoadMoves) {
  Strip strip = strip_of_joint({});
  strip.motion.ddq.setZero();
  strip.motion.dq.setConstant(-0.7);
  strip.direction.setConstant(-1.0);
  Eigen::MatrixXd const columns = memory_columns(strip, strip.torque, 1.0);
  ASSERT_EQ(columns.cols(), 4);
  EXPECT_EQ(columns.leftCols(2).cwiseAbs().maxCoeff(), 0.0);
  Eigen::VectorXd const torque = on_rows(strip, strip.torque).col(0);
  EXPECT_LT((columns.col(2) - 0.7 * torque).norm(), 1e-12 * torque.norm());
  EXPECT_LT((columns.col(3).array() + 0.7).abs().maxCoeff(), 1e-9);
}

TEST(MemoryColumns, ALoadFollowsASlowAccelerationAndLeavesAFastOne) {
  Strip strip = strip_of_joint({});
  double const rate_hz = strip.motion.rate_hz;
  for (auto const& [hz, gain] : {std::pair{0.1, 1.0}, {1.0, 2.5}, {5.0, 1.0 / 24.1}}) {
    for (Eigen::Index k = 0; k < strip.size(); ++k)
      strip.motion.ddq[k] = std::sin(2.0 * std::numbers::pi * hz * static_cast<double>(k) / rate_hz);
    Eigen::MatrixXd const columns = memory_columns(strip, strip.torque, 1.0);
    Eigen::VectorXd const settled = columns.col(0).tail(columns.rows() / 2);
    EXPECT_NEAR(settled.cwiseAbs().maxCoeff(), gain, 0.05 * gain + 0.005) << hz << " Hz";
  }
}

TEST(MemoryColumns, FrequenciesGoFromTenPeriodsToHalfOfTheCutOff) {
  std::vector<Strip> const strips{strip_of_joint({})};
  std::vector<double> const frequencies = memory_frequencies(strips);
  ASSERT_GT(frequencies.size(), 4U);
  EXPECT_NEAR(frequencies.front(), 0.5, 0.01);
  EXPECT_LE(frequencies.back(), 0.5 * strips.front().filters->cutoff_hz);
  for (std::size_t i = 1; i < frequencies.size(); ++i) EXPECT_NEAR(frequencies[i] / frequencies[i - 1], 1.414, 0.001);
}

TEST(MemoryColumns, ALoadOnASpringStandsOutWhereNoFunctionOfTheMotionDoes) {
  GivenJoint joint;
  LargestCorrection const sound = largest_correction({recording_of(joint)});
  auto const load = load_torque(joint, 1.3, 0.02);
  joint.timed = [load](double t, double) { return load(t); };
  LargestCorrection const loaded = largest_correction({recording_of(joint)});
  EXPECT_EQ(loaded.axis, SignatureAxis::frequency);
  EXPECT_GT(loaded.gain, sound.gain);
  EXPECT_LT(sound.rms, 0.001);
  EXPECT_GT(loaded.rms, 0.1);
}

}  // namespace memory_columns_test
