#include "engine/robot/inverse_dynamics.hpp"

#include <gtest/gtest.h>

#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace inverse_dynamics_test {

TEST(ArmRegressor, TimesParametersEqualsInverseDynamics) {
  for (std::uint32_t number = 0; number < 200; ++number) {
    auto const arm = test::random_arm(number, number % 2 == 0);
    for (auto const drives : {DriveInertias::left_out, DriveInertias::included}) {
      auto const chi = standard_parameters(arm.chain, drives);
      Eigen::VectorXd const tau = inverse_dynamics(arm.chain, chi, arm.q, arm.dq, arm.ddq);
      Eigen::VectorXd const sum = arm_regressor(arm.chain, arm.q, arm.dq, arm.ddq, drives) * chi;
      EXPECT_LT((tau - sum).norm(), 1e-12 * tau.norm()) << number;
    }
  }
}

TEST(ArmRegressor, ARowHasOnlyLinksBehindItsJoint) {
  auto const arm = test::random_arm(3, false);
  auto const phi = arm_regressor(arm.chain, arm.q, arm.dq, arm.ddq);
  ASSERT_GT(arm.chain.size(), 1);
  for (Eigen::Index row = 1; row < phi.rows(); ++row)
    EXPECT_EQ(phi.row(row).head(numbers_per_link * row).norm(), 0.0) << row;
}

TEST(GravityTorque, IsThatOfAnArmAtRest) {
  // one joint about a horizontal axis: m g r cos q
  SerialChain chain;
  chain.joints.resize(1);
  chain.joints[0].alpha = 1.5707963267948966;
  chain.links.push_back(LinkInertia::from_centre(2.0, {0.4, 0.0, 0.0}, Eigen::Matrix3d::Zero()));
  auto const tau = gravity_torque(chain, standard_parameters(chain, DriveInertias::left_out), Eigen::VectorXd::Zero(1));
  EXPECT_NEAR(tau[0], 2.0 * 9.81 * 0.4, 1e-12);
}

}  // namespace inverse_dynamics_test
}  // namespace torquescope
