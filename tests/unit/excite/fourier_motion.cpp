#include "engine/fit/excite/fourier_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace torquescope {
namespace fourier_motion_test {

FourierMotion example() {
  FourierMotion motion{4.0, {}};
  motion.joints.push_back({0.3, Eigen::Vector3d{0.5, -0.2, -0.3}, Eigen::Vector3d{0.6, 0.15, -0.3}});
  return motion;
}

TEST(FourierMotion, BeginsAtRest) {
  auto const samples = samples_of(example(), FourierTable(100, 3));
  EXPECT_NEAR(samples.dq(0, 0), 0.0, 1e-15);
  EXPECT_NEAR(samples.ddq(0, 0), 0.0, 1e-14);
  EXPECT_GT(samples.dq.cwiseAbs().maxCoeff(), 0.5);
}

TEST(FourierMotion, SpeedAndAccelerationAreDerivatives) {
  Eigen::Index const n = 4000;
  auto const at = samples_of(example(), FourierTable(n, 3));
  double const step_s = 4.0 / static_cast<double>(n);
  for (Eigen::Index i = 1; i + 1 < n; i += 17) {
    EXPECT_NEAR((at.q(i + 1, 0) - at.q(i - 1, 0)) / (2.0 * step_s), at.dq(i, 0), 1e-5);
    EXPECT_NEAR((at.dq(i + 1, 0) - at.dq(i - 1, 0)) / (2.0 * step_s), at.ddq(i, 0), 1e-4);
  }
  EXPECT_NEAR(at.q.mean(), 0.3, 1e-12);
}

}  // namespace fourier_motion_test
}  // namespace torquescope
