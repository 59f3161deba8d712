// Which samples count as moving.

#include "engine/infer/pipeline/reversal_mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using torquescope::moving_samples;

namespace reversal_mask_test {

constexpr double rate_hz = 1000.0;

// sin(2 pi t), 2 s: reversals at 0, 0.5, 1, 1.5 s
Eigen::VectorXd sine() {
  Eigen::VectorXd dq(2000);
  for (Eigen::Index k = 0; k < dq.size(); ++k)
    dq[k] = std::sin(2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / rate_hz);
  return dq;
}

TEST(ReversalMask, DropsEverythingWithin1Point6PeriodsOfTheCutoff) {
  auto const moving = moving_samples(sine(), rate_hz, 40.0);
  // 40 ms each side of 0.5 s and of the samples slower than 0.5 % of the peak beside it
  EXPECT_FALSE(moving[500 - 40]);
  EXPECT_FALSE(moving[499 + 40]);
  EXPECT_TRUE(moving[500 - 43]);
  EXPECT_TRUE(moving[499 + 43]);
  EXPECT_TRUE(moving[750]);
}

TEST(ReversalMask, DropsASlowCreepThatNeverTurns) {
  Eigen::VectorXd dq = Eigen::VectorXd::Ones(1000);
  dq.segment(400, 100).setConstant(0.0049);
  auto const moving = moving_samples(dq, rate_hz, 0.0);
  for (std::size_t k = 0; k < moving.size(); ++k) EXPECT_EQ(moving[k], k < 400 || k >= 500) << k;
}

TEST(ReversalMask, KeepsASlowlyMovingStretchAboveTheThreshold) {
  Eigen::VectorXd dq = Eigen::VectorXd::Ones(1000);
  dq.segment(400, 100).setConstant(0.0051);
  auto const moving = moving_samples(dq, rate_hz, 0.0);
  EXPECT_EQ(std::count(moving.begin(), moving.end(), false), 0);
}

TEST(ReversalMask, FindsAReversalBetweenTwoFastSamples) {
  Eigen::VectorXd dq = Eigen::VectorXd::Ones(1000);
  dq.tail(500).setConstant(-1.0);
  auto const moving = moving_samples(dq, rate_hz, 160.0);
  for (std::size_t k = 0; k < moving.size(); ++k) EXPECT_EQ(moving[k], k < 490 || k > 510) << k;
}

// a recording that begins with the drive back to where the test starts
TEST(ReversalMask, KeepsASlowTestBehindOneFastMove) {
  Eigen::VectorXd dq = Eigen::VectorXd::Ones(1000);
  dq.head(40).setConstant(-150.0);
  auto const moving = moving_samples(dq, rate_hz, 0.0);
  for (std::size_t k = 0; k < moving.size(); ++k) EXPECT_EQ(moving[k], k != 40) << k;
}

// the noise of the speed is no motion, however long it lasts
TEST(ReversalMask, DropsTheRestRoundOneShortMove) {
  Eigen::VectorXd dq(2000);
  for (Eigen::Index k = 0; k < dq.size(); ++k) dq[k] = k % 3 == 0 ? 1e-3 : -5e-4;
  dq.segment(1000, 60).setOnes();
  auto const moving = moving_samples(dq, rate_hz, 0.0);
  for (std::size_t k = 0; k < moving.size(); ++k) EXPECT_EQ(moving[k], k >= 1000 && k < 1060) << k;
}

TEST(ReversalMask, DropsAJointThatNeverMoves) {
  auto const moving = moving_samples(Eigen::VectorXd::Zero(100), rate_hz, 0.0);
  EXPECT_EQ(std::count(moving.begin(), moving.end(), true), 0);
}

}  // namespace reversal_mask_test
