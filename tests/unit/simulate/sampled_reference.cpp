#include "engine/simulate/sampled_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace torquescope {
namespace sampled_reference_test {

constexpr double omega = 2.0 * std::numbers::pi;

// one period of a sine, which ends where it begins
SampledMotion sine(Eigen::Index pieces) {
  SampledMotion motion{1.0 / static_cast<double>(pieces), Eigen::VectorXd(pieces + 1), Eigen::VectorXd(pieces + 1),
                       Eigen::VectorXd(pieces + 1)};
  for (Eigen::Index i = 0; i <= pieces; ++i) {
    double const angle = omega * static_cast<double>(i) * motion.step_s;
    motion.q[i] = std::sin(angle);
    motion.dq[i] = omega * std::cos(angle);
    motion.ddq[i] = -omega * omega * std::sin(angle);
  }
  return motion;
}

TEST(SampledReference, PassesThroughItsSamples) {
  auto const motion = sine(8);
  auto const reference = sampled_reference(motion);
  for (Eigen::Index i = 0; i < 8; ++i) {
    auto const at = reference->at(static_cast<double>(i) * motion.step_s);
    EXPECT_NEAR(at.q, motion.q[i], 1e-14);
    EXPECT_NEAR(at.dq, motion.dq[i], 1e-13);
    EXPECT_NEAR(at.ddq, motion.ddq[i], 1e-12);
  }
}

TEST(SampledReference, ErrorIsWithinItsBoundBetweenSamples) {
  auto const reference = sampled_reference(sine(16));
  double const bound = std::pow(omega / 16.0, 6) / 46080.0;
  double worst = 0.0;
  for (int k = 0; k < 1000; ++k)
    worst = std::max(worst, std::abs(reference->at(1e-3 * k).q - std::sin(1e-3 * omega * k)));
  EXPECT_LE(worst, bound);
  EXPECT_GT(worst, 0.5 * bound);
}

TEST(SampledReference, RepeatsItself) {
  auto const reference = sampled_reference(sine(16));
  EXPECT_NEAR(reference->at(7.3).q, reference->at(0.3).q, 1e-13);
  EXPECT_NEAR(reference->at(7.3).ddq, reference->at(0.3).ddq, 1e-10);
}

}  // namespace sampled_reference_test
}  // namespace torquescope
