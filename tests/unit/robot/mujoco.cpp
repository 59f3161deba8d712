// Torques and accelerations of random arms against MuJoCo.

#include <gtest/gtest.h>

#if defined(TORQUESCOPE_MUJOCO)

#include "engine/robot/base_parameters.hpp"
#include "engine/robot/forward_dynamics.hpp"
#include "unit/robot/example_arms.hpp"
#include "unit/robot/mujoco_model.hpp"

namespace torquescope {
namespace mujoco_test {

TEST(InverseDynamics, IsThatOfMujoco) {
  for (std::uint32_t number = 0; number < 100; ++number) {
    auto const arm = test::random_arm(number, number % 2 == 0);
    auto const chi = standard_parameters(arm.chain, DriveInertias::included);
    auto const expected = test::MujocoModel(arm.chain).inverse_dynamics(arm.q, arm.dq, arm.ddq);
    auto const tau = inverse_dynamics(arm.chain, chi, arm.q, arm.dq, arm.ddq);
    EXPECT_LT((tau - expected).norm(), 1e-12 * expected.norm()) << number;
  }
}

TEST(ForwardDynamics, OfBaseParametersIsThatOfMujoco) {
  for (std::uint32_t number = 0; number < 100; ++number) {
    auto const arm = test::random_arm(number, number % 2 == 0);
    BaseParameters const base(arm.chain, DriveInertias::included);
    auto const chi = standard_parameters(arm.chain, DriveInertias::included);
    auto const reduced = base.to_standard(base.from_standard(chi));
    Eigen::VectorXd const tau = 50.0 * arm.ddq;
    auto const expected = test::MujocoModel(arm.chain).forward_dynamics(arm.q, arm.dq, tau);
    auto const ddq = forward_dynamics(arm.chain, reduced, arm.q, arm.dq, tau);
    EXPECT_LT((ddq - expected).norm(), 1e-12 * expected.norm()) << number;
  }
}

}  // namespace mujoco_test
}  // namespace torquescope

#else

TEST(InverseDynamics, IsThatOfMujoco) { GTEST_SKIP() << "MuJoCo is not installed (libmujoco-dev)"; }

#endif
