// Which reference is none: the measured motion itself, exact, rounded or with noise; and that a loop's error is no
// echo.

#include "engine/infer/pipeline/echoed_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace echoed_reference_test {

constexpr double encoder_step = 1e-4;

double way(double t) { return std::sin(1.3 * t) + 0.2 * std::sin(5.0 * t); }

// the position is where the reference was lag_s before, in steps of the encoder, with noise
Recording recorded(double lag_s, double step, double noise) {
  Recording recording;
  recording.rate_hz = 500.0;
  Eigen::Index const n = 10000;
  recording.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / recording.rate_hz);
  recording.reference = recording.time_s.unaryExpr(&way);
  RandomStream stream({41, 0, RandomDomain::test}, 0, 0);
  recording.position = recording.time_s.unaryExpr([&](double t) {
    double const q = way(t - lag_s) + noise * stream.normal();
    return step > 0.0 ? step * std::round(q / step) : q;
  });
  recording.torque = Eigen::VectorXd::Zero(n);
  recording.rows.encoder_step = step;
  return recording;
}

TEST(EchoedReference, IsTheMotionExactRoundedOrWithNoise) {
  EXPECT_TRUE(has_echoed_reference(recorded(0.0, 0.0, 0.0)));
  EXPECT_TRUE(has_echoed_reference(recorded(0.0, encoder_step, 0.0)));
  EXPECT_TRUE(has_echoed_reference(recorded(0.0, 0.0, 3e-4)));
  EXPECT_EQ(without_echoed_reference(recorded(0.0, encoder_step, 0.0)).reference.size(), 0);
}

TEST(EchoedReference, IsNotWhatALoopFollows) {
  // a lag of 5 ms is 70 steps of the encoder; one of 0.2 ms hides in the noise, row by row
  EXPECT_FALSE(has_echoed_reference(recorded(5e-3, encoder_step, 0.0)));
  EXPECT_FALSE(has_echoed_reference(recorded(2e-4, 0.0, 5e-4)));
  EXPECT_EQ(without_echoed_reference(recorded(5e-3, encoder_step, 0.0)).reference.size(), 10000);
}

TEST(EchoedReference, IsNoneWhereNoneWasRecorded) {
  Recording recording = recorded(0.0, encoder_step, 0.0);
  recording.reference.resize(0);
  EXPECT_FALSE(has_echoed_reference(recording));
}

}  // namespace echoed_reference_test
}  // namespace torquescope
