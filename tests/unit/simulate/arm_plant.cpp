#include "engine/simulate/arm_plant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "engine/simulate/joint_plant.hpp"
#include "unit/robot/arm_energy.hpp"
#include "unit/simulate/arms.hpp"
#if defined(TORQUESCOPE_MUJOCO)
#include "unit/robot/mujoco_model.hpp"
#endif

namespace torquescope {
namespace arm_plant_test {

using Eigen::Index;
using Eigen::VectorXd;

ArmState start_of(test::RandomArm const& arm) { return {0.0, arm.q, arm.dq}; }

double energy(SerialChain const& chain, ArmState const& state) {
  auto const chi = standard_parameters(chain, DriveInertias::included);
  return test::kinetic_energy(chain, chi, state.q, state.dq) + test::potential_energy(chain, chi, state.q);
}

ArmState moved(ArmPlant&& plant, ArmState state, VectorXd const& u, double duration_s, int steps) {
  for (int k = 0; k < steps; ++k) plant.advance(state, u, duration_s / steps);
  return state;
}

TEST(ArmPlant, FallingWithoutFrictionKeepsItsEnergy) {
  auto const arm = test::random_arm(8, false);
  auto const start = start_of(arm);
  VectorXd const none = VectorXd::Zero(arm.chain.size());
  auto const loss = [&](int steps) {
    return std::abs(energy(arm.chain, moved(test::arm_plant(arm.chain), start, none, 0.2, steps)) -
                    energy(arm.chain, start));
  };
  EXPECT_LT(loss(4000), 1e-6 * std::abs(energy(arm.chain, start)));
  EXPECT_GT(loss(1000) / loss(2000), 3.5);  // of second order at least
}

TEST(ArmPlant, AccelerationUndoesInverseDynamics) {
  for (std::uint32_t number = 0; number < 50; ++number) {
    auto const arm = test::random_arm(number, number % 2 == 0, true);
    ArmPlant plant = test::arm_plant(arm.chain, {{"viscous", 0.7}, {"coulomb", 0.4}, {"offset", -0.1}});
    VectorXd const u = plant.inverse_dynamics(start_of(arm), arm.ddq);
    EXPECT_LT((plant.acceleration(start_of(arm), u) - arm.ddq).norm(), 1e-10 * arm.ddq.norm()) << number;
  }
}

TEST(ArmPlant, OfOneJointMovesAsTheJointPlant) {
  SerialChain chain;
  chain.joints.resize(1);
  chain.gravity = {0.0, -9.81, 0.0};
  chain.links.push_back(LinkInertia::from_centre(2.0, {0.3, 0.0, 0.0}, 0.05 * Eigen::Matrix3d::Identity()));
  ArmPlant plant = test::arm_plant(chain, {{"viscous", 0.2}, {"coulomb", 0.5}});
  // weight: 2 kg 0.3 m 9.81 m/s^2 cos(q); inertia: 0.05 + 2 * 0.09
  JointPlant const joint(test::plant({{"inertia", 0.23}, {"gravity_cos", 5.886}, {"viscous", 0.2}, {"coulomb", 0.5}}));
  ArmState arm{0.0, VectorXd::Constant(1, 0.4), VectorXd::Zero(1)};
  JointState alone{0.0, 0.4, 0.0, 0.0};
  for (int k = 0; k < 5000; ++k) {
    double const u = 6.0 * std::sin(7.0 * alone.time_s);
    plant.advance(arm, VectorXd::Constant(1, u), 1e-3);
    alone = joint.advance(alone, u, 1e-3);
    ASSERT_NEAR(arm.q[0], alone.q, 1e-9) << k;
  }
  EXPECT_GT(std::abs(alone.q - 0.4), 0.1);
}

TEST(ArmPlant, FrictionHoldsAnArmExactlyBelowBreakaway) {
  auto const arm = test::random_arm(8, false, true);
  ArmPlant plant = test::arm_plant(arm.chain, {{"coulomb", 2.0}});
  ArmState state{0.0, arm.q, VectorXd::Zero(arm.chain.size())};
  VectorXd const weight = plant.inverse_dynamics(state, VectorXd::Zero(arm.chain.size()));
  for (int k = 0; k < 500; ++k)
    plant.advance(state, weight + VectorXd::Constant(arm.chain.size(), 1.999 * std::sin(0.1 * k)), 1e-3);
  EXPECT_EQ(state.q, arm.q);
  EXPECT_TRUE(state.dq.isZero(0.0));
}

// one joint is pushed over its breakaway torque: it moves, and no other joint that friction can hold
TEST(ArmPlant, OneJointBreaksAwayWhileOthersAreHeld) {
  auto const arm = test::random_arm(8, false, true);
  Index const n = arm.chain.size();
  ArmPlant plant = test::arm_plant(arm.chain, {{"coulomb", 2.0}});
  ArmState state{0.0, arm.q, VectorXd::Zero(n)};
  VectorXd u = plant.inverse_dynamics(state, VectorXd::Zero(n));
  u[n - 1] += 2.02;
  plant.advance(state, u, 1e-3);
  EXPECT_GT(state.dq[n - 1], 0.0);
  EXPECT_TRUE(state.dq.head(n - 1).isZero(0.0));
}

TEST(ArmPlant, ComesToRestExactly) {
  auto const arm = test::random_arm(8, false, true);
  ArmPlant plant = test::arm_plant(arm.chain, {{"coulomb", 2000.0}});
  auto const end = moved(std::move(plant), start_of(arm), VectorXd::Zero(arm.chain.size()), 0.5, 500);
  EXPECT_TRUE(end.dq.isZero(0.0));
}

TEST(ArmPlant, IsOfSecondOrderThroughReversals) {
  auto const arm = test::random_arm(8, false, true);
  Index const n = arm.chain.size();
  auto const end = [&](int steps) {
    ArmPlant plant = test::arm_plant(arm.chain, {{"viscous", 0.5}, {"coulomb", 0.6}});
    ArmState state{0.0, arm.q, VectorXd::Zero(n)};
    VectorXd const weight = plant.inverse_dynamics(state, VectorXd::Zero(n));
    for (int k = 0; k < steps; ++k) {
      double const middle_s = (k + 0.5) / steps;
      plant.advance(state, weight + VectorXd::Constant(n, 3.0 * std::sin(25.0 * middle_s)), 1.0 / steps);
    }
    return state.q;
  };
  VectorXd const exact = end(32000);
  double const coarse = (end(500) - exact).norm(), fine = (end(4000) - exact).norm();
  EXPECT_GT(std::log2(coarse / fine) / 3.0, 1.7);
}

// Dahl's controller: below breakaway a joint on bristles gives way by - D ln(1 - u / F), where dry friction would hold
// it
TEST(ArmPlant, EffectsMayRemember) {
  auto const arm = test::random_arm(8, false, true);
  Effect const& presliding = *find_effect("presliding");
  std::vector<ArmJointTerms> terms = test::every_joint(arm.chain, {{"viscous", 2.0}, {"coulomb", 0.5}});
  double const level = 0.5, distance = 1e-3, push = 0.2;
  for (auto& joint : terms) joint.remembering.push_back({&presliding, {level, 0.0, distance}});
  ArmPlant plant(arm.chain, standard_parameters(arm.chain, DriveInertias::included), terms);
  Index const n = arm.chain.size();
  ArmState state{0.0, arm.q, VectorXd::Zero(n)};
  VectorXd u = plant.inverse_dynamics(state, VectorXd::Zero(n));
  // slowly: bristles that swing too far stay bent
  for (int k = 0; k < 4000; ++k) {
    u[n - 1] += push / 4000.0;
    plant.advance(state, u, 2.5e-4);
  }
  double const expected = -distance * std::log(1.0 - push / level);
  EXPECT_NEAR(state.q[n - 1] - arm.q[n - 1], expected, 0.02 * expected);
}

#if defined(TORQUESCOPE_MUJOCO)
TEST(ArmPlant, MovesAsMujocoSays) {
  for (std::uint32_t const number : {2u, 5u, 8u}) {
    auto const arm = test::random_arm(number, false, true);
    Index const n = arm.chain.size();
    test::MujocoModel mujoco(arm.chain);
    double const viscous = 0.5;
    VectorXd const u = VectorXd::LinSpaced(n, -2.0, 3.0);
    // classical Runge-Kutta steps of MuJoCo's accelerations
    VectorXd state(2 * n);
    state << arm.q, arm.dq;
    auto const slope = [&](VectorXd const& at) {
      VectorXd change(2 * n);
      change << at.tail(n), mujoco.forward_dynamics(at.head(n), at.tail(n), u - viscous * at.tail(n));
      return change;
    };
    double const step_s = 5e-4;
    for (int k = 0; k < 400; ++k) {
      VectorXd const a = slope(state), b = slope(state + 0.5 * step_s * a), c = slope(state + 0.5 * step_s * b),
                     d = slope(state + step_s * c);
      state += step_s / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    // errors of second order: two step sizes say where they go
    auto const at = [&](int steps) {
      return moved(test::arm_plant(arm.chain, {{"viscous", viscous}}), start_of(arm), u, 0.2, steps).q;
    };
    VectorXd const coarse = at(2000), fine = at(4000), limit = fine + (fine - coarse) / 3.0;
    EXPECT_LT((limit - state.head(n)).norm(), 1e-7 * (state.head(n) - arm.q).norm()) << number;
  }
}
#endif

}  // namespace arm_plant_test
}  // namespace torquescope
