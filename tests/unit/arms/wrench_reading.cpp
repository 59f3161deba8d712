// The frame and the side of a wrench at the tip: those that were written, or others that fit the arm.

#include "engine/diagnose/arms/wrench_reading.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/robot/tip_wrench.hpp"
#include "unit/arms/setup_samples.hpp"

namespace torquescope {
namespace wrench_reading_test {

using Eigen::Index;

// of the small arm with a wrench along the tip's axes on it, which was read as `factor` times one of this frame
ArmSamples read_as(WrenchFrame frame, double factor) {
  SerialChain const chain = test::small_arm(false);
  ArmSamples samples = test::small_arm_moved();
  Eigen::MatrixXd wrench(samples.size(), 6);
  for (Index k = 0; k < samples.size(); ++k)
    for (Index c = 0; c < 6; ++c)
      wrench(k, c) = (c < 3 ? 20.0 : 2.0) * std::sin((0.9 + 0.37 * static_cast<double>(c)) * samples.time_s[k]);
  Eigen::MatrixXd const outside = torques_of_wrench(chain, samples.q, wrench, WrenchFrame::tip);
  WrenchFrame const other = frame == WrenchFrame::tip ? WrenchFrame::base : WrenchFrame::tip;
  samples.outside = torques_of_wrench(chain, samples.q, factor * wrench, frame);
  samples.outside_otherwise = torques_of_wrench(chain, samples.q, factor * wrench, other);
  samples.tau += samples.outside - outside;
  return samples;
}

WrenchFit fitted(WrenchFrame frame, double factor) {
  return fit_wrench(read_as(frame, factor), test::small_arm(false));
}

TEST(WrenchReading, AsItIsExplainsTheTorque) {
  WrenchFit const fit = fitted(WrenchFrame::tip, 1.0);
  EXPECT_EQ(fit.best, WrenchReading::as_written);
  EXPECT_GT(fit.without.maxCoeff(), 0.1);
  EXPECT_LT(fit.as_written.maxCoeff(), 1e-3);
}

TEST(WrenchReading, OfAnotherSideOrFrameIsTold) {
  EXPECT_EQ(fitted(WrenchFrame::tip, -1.0).best, WrenchReading::other_side);
  EXPECT_EQ(fitted(WrenchFrame::base, 1.0).best, WrenchReading::other_frame);
  EXPECT_EQ(fitted(WrenchFrame::base, -1.0).best, WrenchReading::other_side_and_frame);
  EXPECT_LT(fitted(WrenchFrame::base, -1.0).at_best.maxCoeff(), 1e-3);
}

}  // namespace wrench_reading_test
}  // namespace torquescope
