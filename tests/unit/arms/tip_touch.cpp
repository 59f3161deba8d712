// A push at the tip for a moment is found with its time and force; one joint's own jump, and noise alone, are not.

#include "engine/diagnose/arms/tip_touch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/robot/tip_wrench.hpp"
#include "unit/arms/setup_samples.hpp"

namespace torquescope {
namespace tip_touch_test {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double noise = 0.1;

// 30 s of the small arm: what its fit leaves is noise, and `more` [n][N] beside it
RegressionData rows_with(MatrixXd const& more, ArmSamples const& samples) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, noise);
  Index const n = more.rows(), joints = more.cols();
  RegressionData rows;
  rows.arm.emplace(RegressionData::Arm{});
  rows.arm->scale = Eigen::VectorXd::Ones(joints);
  rows.arm->first_instant = {0, n};
  rows.kept_rate_hz = 1.0 / (samples.time_s[1] - samples.time_s[0]);
  rows.phi = MatrixXd::Zero(n * joints, joints);
  for (auto signal :
       {&RegressionData::tau, &RegressionData::time_s, &RegressionData::q, &RegressionData::dq, &RegressionData::ddq})
    (rows.*signal).setZero(n * joints);
  rows.first_row = {0};
  for (Index j = 0; j < joints; ++j) {
    for (Index i = 0; i < n; ++i) {
      Index const row = j * n + i;
      rows.time_s[row] = samples.time_s[i];
      rows.q[row] = samples.q(i, j);
      rows.dq[row] = samples.dq(i, j);
      rows.phi(row, j) = rows.dq[row];
      rows.tau[row] = 2.0 * rows.dq[row] + more(i, j) + normal(random);
      rows.arm->instant.push_back(i);
    }
    rows.arm->joint.push_back(static_cast<std::size_t>(j));
    rows.first_row.push_back((j + 1) * n);
  }
  return rows;
}

struct Case {
  SerialChain chain = test::small_arm(false);
  ArmSamples samples = test::small_arm_moved();
  MatrixXd more = MatrixXd::Zero(samples.size(), samples.q.cols());

  std::optional<TipTouch> found() const { return find_tip_touch(rows_with(more, samples), {}, chain); }
};

constexpr Index begin = 400, length = 12;

TEST(TipTouch, IsFoundWithItsTimeAndForce) {
  Case one;
  for (Index i = begin; i < begin + length; ++i) {
    MatrixXd wrench = MatrixXd::Zero(1, 6);
    wrench.leftCols(3) << 2.0, -3.0, 6.0;
    one.more.row(i) = torques_of_wrench(one.chain, one.samples.q.row(i), wrench, WrenchFrame::base);
  }
  auto const touch = one.found();
  ASSERT_TRUE(touch.has_value());
  EXPECT_NEAR(touch->from_s, one.samples.time_s[begin], 0.05);
  EXPECT_NEAR(touch->until_s, one.samples.time_s[begin + length - 1], 0.05);
  EXPECT_GE(touch->joints.size(), 2U);
  ASSERT_TRUE(touch->force.has_value());
  EXPECT_NEAR(*touch->force, 7.0, 1.5);
}

TEST(TipTouch, IsNotFoundInNoiseNorAtOneJointAlone) {
  Case one;
  EXPECT_FALSE(one.found().has_value());
  one.more.col(1).segment(begin, length).setConstant(20.0 * noise);
  EXPECT_FALSE(one.found().has_value());
}

}  // namespace tip_touch_test
}  // namespace torquescope
