// Which samples lie outside of the motion that a fit has seen.

#include "engine/infer/pipeline/trained_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

using torquescope::samples_outside;
using torquescope::trained_motion;
using torquescope::TrainedMotion;

namespace trained_motion_test {

constexpr double memory = 4.0;  // of 400 samples

// speed and its direction: a joint that goes to and fro, as fast as `peak`
Eigen::MatrixXd columns(double peak) {
  Eigen::MatrixXd x(400, 2);
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    double const speed = peak * std::sin(0.1 * (static_cast<double>(k) + 0.5));
    x.row(k) << speed, (speed > 0.0 ? 1.0 : -1.0);
  }
  return x;
}

TEST(TrainedMotion, HoldsAllThatTrainingHas) {
  TrainedMotion const trained = trained_motion(columns(2.0), memory);
  for (bool const outside : samples_outside(trained, columns(2.0), 0)) EXPECT_FALSE(outside);
}

TEST(TrainedMotion, FindsWhatIsFasterWhateverTheUnits) {
  TrainedMotion const trained = trained_motion(columns(2.0), memory);
  Eigen::MatrixXd const other = columns(40.0);
  auto const outside = samples_outside(trained, other, 0);
  // a hundred independent samples at 1.4 rms: their fit is worse than the noise from ten times that on, or a little
  // below, since speed and direction are correlated
  for (Eigen::Index k = 0; k < other.rows(); ++k) {
    double const speed = std::abs(other(k, 0));
    if (speed > 14.0) {
      EXPECT_TRUE(outside[static_cast<std::size_t>(k)]) << k;
    }
    if (speed < 5.0) {
      EXPECT_FALSE(outside[static_cast<std::size_t>(k)]) << k;
    }
  }
  TrainedMotion const in_degrees = trained_motion(57.3 * columns(2.0), memory);
  EXPECT_EQ(samples_outside(in_degrees, 57.3 * other, 0), outside);
}

TEST(TrainedMotion, WidensByTheReachOfTheFilter) {
  TrainedMotion const trained = trained_motion(columns(2.0), memory);
  Eigen::MatrixXd other = columns(2.0);
  other(100, 0) = 50.0;
  auto const outside = samples_outside(trained, other, 7);
  for (std::size_t k = 0; k < outside.size(); ++k) EXPECT_EQ(outside[k], k >= 93 && k <= 107) << k;
}

// two columns that are one number in training tell nothing of where they part
TEST(TrainedMotion, MeetsDependentColumns) {
  Eigen::MatrixXd x(50, 2);
  x.col(0).setLinSpaced(1.0, 2.0);
  x.col(1) = 3.0 * x.col(0);
  TrainedMotion const trained = trained_motion(x, memory);
  EXPECT_EQ(trained.coordinates.cols(), 1);
  EXPECT_FALSE(samples_outside(trained, x.topRows(49), 0)[0]);
}

}  // namespace trained_motion_test
