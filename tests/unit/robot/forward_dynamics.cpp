#include "engine/robot/forward_dynamics.hpp"

#include <gtest/gtest.h>

#include "engine/robot/base_parameters.hpp"
#include "unit/robot/arm_energy.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace forward_dynamics_test {

TEST(ForwardDynamics, UndoesInverseDynamics) {
  for (std::uint32_t number = 0; number < 100; ++number) {
    auto const arm = test::random_arm(number, number % 2 == 0);
    auto const chi = standard_parameters(arm.chain, DriveInertias::included);
    auto const tau = inverse_dynamics(arm.chain, chi, arm.q, arm.dq, arm.ddq);
    auto const ddq = forward_dynamics(arm.chain, chi, arm.q, arm.dq, tau);
    EXPECT_LT((ddq - arm.ddq).norm(), 1e-12 * arm.ddq.norm()) << number;
  }
}

TEST(ForwardDynamics, OfBaseParametersIsThatOfTheFullOnes) {
  for (std::uint32_t number = 0; number < 100; ++number) {
    auto const arm = test::random_arm(number, number % 2 == 0);
    auto const chi = standard_parameters(arm.chain, DriveInertias::included);
    BaseParameters const base(arm.chain, DriveInertias::included);
    auto const reduced = base.to_standard(base.from_standard(chi));
    ASSERT_TRUE(is_positive_definite(mass_matrix(arm.chain, reduced, arm.q)));
    Eigen::VectorXd const tau = 50.0 * arm.ddq;
    auto const full = forward_dynamics(arm.chain, chi, arm.q, arm.dq, tau);
    EXPECT_LT((forward_dynamics(arm.chain, reduced, arm.q, arm.dq, tau) - full).norm(), 1e-12 * full.norm()) << number;
  }
}

TEST(MassMatrix, IsTwiceTheKineticEnergy) {
  for (std::uint32_t number = 0; number < 50; ++number) {
    auto const arm = test::random_arm(number, number % 2 == 0);
    auto const chi = standard_parameters(arm.chain, DriveInertias::included);
    double const twice = arm.dq.dot(mass_matrix(arm.chain, chi, arm.q) * arm.dq);
    EXPECT_NEAR(2.0 * test::kinetic_energy(arm.chain, chi, arm.q, arm.dq), twice, 1e-12 * twice);
  }
}

// the last motor turns with the joint before its own
TEST(MassMatrix, OfCoupledDrivesIsWhatInverseDynamicsAndColumnsSay) {
  for (std::uint32_t number = 0; number < 50; ++number) {
    auto arm = test::random_arm(number, false);
    Eigen::Index const n = arm.chain.size();
    if (n < 2) continue;
    arm.chain.transmission = Eigen::MatrixXd::Identity(n, n);
    arm.chain.transmission(n - 1, n - 2) = 0.7;
    auto const chi = standard_parameters(arm.chain, DriveInertias::included);
    auto const torque = [&](Eigen::VectorXd const& ddq) {
      return inverse_dynamics(arm.chain, chi, arm.q, arm.dq, ddq);
    };
    Eigen::VectorXd const pushed = torque(arm.ddq);
    EXPECT_LT((mass_matrix(arm.chain, chi, arm.q) * arm.ddq - (pushed - torque(0.0 * arm.ddq))).norm(),
              1e-11 * pushed.norm());
    EXPECT_LT((arm_regressor(arm.chain, arm.q, arm.dq, arm.ddq, DriveInertias::included) * chi - pushed).norm(),
              1e-11 * pushed.norm());
    BaseParameters const base(arm.chain, DriveInertias::included);
    Eigen::VectorXd const reduced = base.to_standard(base.from_standard(chi));
    EXPECT_LT((inverse_dynamics(arm.chain, reduced, arm.q, arm.dq, arm.ddq) - pushed).norm(), 1e-9 * pushed.norm());
  }
}

TEST(MassMatrix, OfALinkOfNegativeInertiaIsNotPositiveDefinite) {
  auto const arm = test::random_arm(3, false);
  auto const chi = standard_parameters(arm.chain, DriveInertias::left_out);
  EXPECT_TRUE(is_positive_definite(mass_matrix(arm.chain, chi, arm.q)));
  EXPECT_FALSE(is_positive_definite(mass_matrix(arm.chain, -chi, arm.q)));
}

// no torque, no loss: classical Runge-Kutta steps of a falling arm
TEST(ArmEnergy, OfAFallingArmIsConserved) {
  auto const arm = test::random_arm(8, false);
  auto const chi = standard_parameters(arm.chain, DriveInertias::included);
  Eigen::Index const n = arm.chain.size();
  Eigen::VectorXd state(2 * n), none = Eigen::VectorXd::Zero(n);
  state << arm.q, arm.dq;
  auto const slope = [&](Eigen::VectorXd const& at) {
    Eigen::VectorXd change(2 * n);
    change << at.tail(n), forward_dynamics(arm.chain, chi, at.head(n), at.tail(n), none);
    return change;
  };
  auto const energy = [&] {
    return test::kinetic_energy(arm.chain, chi, state.head(n), state.tail(n)) +
           test::potential_energy(arm.chain, chi, state.head(n));
  };
  double const before = energy(), potential = test::potential_energy(arm.chain, chi, arm.q);
  double const step_s = 1e-4;
  for (int step = 0; step < 500; ++step) {
    Eigen::VectorXd const a = slope(state), b = slope(state + 0.5 * step_s * a), c = slope(state + 0.5 * step_s * b),
                          d = slope(state + step_s * c);
    state += step_s / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  EXPECT_GT(std::abs(test::potential_energy(arm.chain, chi, state.head(n)) - potential), 0.1);  // it has moved
  EXPECT_NEAR(energy(), before, 1e-9 * std::abs(before));
}

}  // namespace forward_dynamics_test
}  // namespace torquescope
