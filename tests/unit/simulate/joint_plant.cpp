#include "engine/simulate/joint_plant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "unit/simulate/plants.hpp"

using namespace torquescope;
using torquescope::test::plant;
using torquescope::test::seed_plant;

namespace joint_plant_test {

JointState simulate(
    JointPlant const& joint, JointState state, double duration_s, int steps,
    std::function<double(JointState const&)> const& torque = [](auto const&) { return 0.0; }) {
  for (int i = 0; i < steps; ++i) state = joint.advance(state, torque(state), duration_s / steps);
  return state;
}

// ratio of the errors of position when the step is halved: 4 for a second-order method
double halving_ratio(JointPlant const& joint, JointState const& start, double duration_s, double u = 0.0) {
  auto const end = [&](int steps) { return simulate(joint, start, duration_s, steps, [=](auto const&) { return u; }); };
  double const exact = end(400000).q;
  return (end(500).q - exact) / (end(1000).q - exact);
}

TEST(JointPlant, ViscousStepResponseIsTheAnalyticOne) {
  double const inertia = 0.0036, viscous = 0.0164, u = 0.05;
  JointPlant const joint(plant({{"inertia", inertia}, {"viscous", viscous}}));
  auto const end = simulate(joint, {}, 0.5, 25000, [=](auto const&) { return u; });
  double const decay = std::exp(-0.5 * viscous / inertia);
  double const limit = u / viscous, tau = inertia / viscous;
  // second order at 20 us: (step / tau)^2 = 8e-9
  EXPECT_NEAR(end.dq, limit * (1.0 - decay), 1e-8);
  EXPECT_NEAR(end.q, limit * (0.5 - tau * (1.0 - decay)), 1e-8);
  EXPECT_NEAR(end.time_s, 0.5, 1e-12);
}

TEST(JointPlant, HalvingTheStepQuartersTheErrorOfASwingingPendulum) {
  JointPlant const joint(plant({{"inertia", 0.1}, {"viscous", 0.05}, {"gravity_sin", 2.0}}));
  EXPECT_NEAR(halving_ratio(joint, {0.0, 1.0, 0.0, 0.0}, 3.0), 4.0, 0.2);
}

TEST(JointPlant, HalvingTheStepQuartersTheErrorAcrossReversals) {
  // swings to and fro a few times before it sticks; the error of each cut is of second order, though not smooth
  JointPlant const joint(plant({{"inertia", 0.1}, {"gravity_sin", 2.0}, {"coulomb", 0.15}, {"offset", 0.05}}));
  auto const end = [&](int steps) { return simulate(joint, {0.0, 1.0, 0.0, 0.0}, 2.0, steps).q; };
  double const exact = end(400000);
  double const coarse = std::abs(end(1000) - exact), fine = std::abs(end(8000) - exact);
  EXPECT_GT(std::log2(coarse / fine) / 3.0, 1.7);
}

TEST(JointPlant, CoulombBrakingStopsAtTheAnalyticPlace) {
  double const inertia = 0.02, coulomb = 0.3, speed = 1.7;
  JointPlant const joint(plant({{"inertia", inertia}, {"coulomb", coulomb}}));
  // constant deceleration: the midpoint rule is exact, and so is the cut
  auto const end = simulate(joint, {0.0, 0.2, speed, 0.0}, 1.0, 777);
  EXPECT_NEAR(end.q, 0.2 + 0.5 * inertia * speed * speed / coulomb, 1e-12);
  EXPECT_EQ(end.dq, 0.0);
}

TEST(JointPlant, RestsExactlyBelowFriction) {
  JointPlant const joint(plant({{"inertia", 0.02}, {"coulomb", 0.3}}));
  auto const end = simulate(joint, {0.0, 0.7, 0.0, 0.0}, 1.0, 1000,
                            [](auto const& state) { return 0.2999 * std::sin(40.0 * state.time_s); });
  EXPECT_EQ(end.q, 0.7);
  EXPECT_EQ(end.dq, 0.0);
  EXPECT_EQ(joint.acceleration(end, 0.2999), 0.0);
}

TEST(JointPlant, BreaksAwayJustAboveFriction) {
  JointPlant const joint(plant({{"inertia", 0.02}, {"coulomb", 0.3}}));
  EXPECT_GT(simulate(joint, {}, 1.0, 100, [](auto const&) { return 0.3001; }).q, 0.0);
  EXPECT_LT(simulate(joint, {}, 1.0, 100, [](auto const&) { return -0.3001; }).q, 0.0);
  EXPECT_NEAR(joint.acceleration({}, 0.5), (0.5 - 0.3) / 0.02, 1e-12);
}

TEST(JointPlant, AsymmetricFrictionHoldsBetweenItsTwoLevels) {
  JointPlant const joint(seed_plant());
  HoldRange const hold = joint.hold_range({});
  EXPECT_DOUBLE_EQ(hold.low, -0.2582);
  EXPECT_DOUBLE_EQ(hold.high, 0.0089);
  for (double u : {-0.2581, -0.1, 0.0, 0.0088}) EXPECT_EQ(joint.acceleration({}, u), 0.0) << u;
  EXPECT_GT(joint.acceleration({}, 0.0090), 0.0);
  EXPECT_LT(joint.acceleration({}, -0.2583), 0.0);
}

TEST(JointPlant, TwoLevelsAreCoulombFrictionWithAnOffset) {
  JointPlant const levels(seed_plant());
  JointPlant const offset(plant({{"inertia", 0.0036},
                                 {"viscous", 0.0164},
                                 {"coulomb", (0.0089 + 0.2582) / 2},
                                 {"offset", (0.0089 - 0.2582) / 2}}));
  auto const torque = [](JointState const& state) { return -0.12 + 0.4 * std::sin(9.0 * state.time_s); };
  auto const one = simulate(levels, {}, 2.0, 20000, torque), two = simulate(offset, {}, 2.0, 20000, torque);
  EXPECT_NEAR(one.q, two.q, 1e-9);
  EXPECT_NEAR(one.dq, two.dq, 1e-9);
}

TEST(JointPlant, FrictionNeverInjectsEnergy) {
  // no motor, no offset: kinetic energy may only fall, at every step, whatever the step
  JointPlant const joint(
      plant({{"inertia", 0.0036}, {"viscous", 0.0164}, {"coulomb_positive", 0.2}, {"coulomb_negative", -0.05}}));
  for (double step_s : {20e-6, 1e-3, 0.05}) {
    for (double speed : {-3.0, -1e-9, 1e-9, 0.4}) {
      JointState state{0.0, 0.0, speed, 0.0};
      for (int i = 0; i < 2000; ++i) {
        JointState const next = joint.advance(state, 0.0, step_s);
        ASSERT_LE(std::abs(next.dq), std::abs(state.dq));
        ASSERT_GE(next.dq * speed, 0.0);
        state = next;
      }
    }
  }
}

TEST(JointPlant, EnergyIsConservedWithoutFriction) {
  JointPlant const joint(plant({{"inertia", 0.1}, {"gravity_sin", 2.0}}));
  auto const energy = [](JointState const& state) { return 0.05 * state.dq * state.dq - 2.0 * std::cos(state.q); };
  JointState const start{0.0, 1.0, 0.0, 0.0};
  // 10 s at 20 us; the midpoint rule drifts by about step^3 per step
  EXPECT_NEAR(energy(simulate(joint, start, 10.0, 500000)), energy(start), 1e-7);
}

TEST(JointPlant, WorkOfTheMotorIsKineticEnergyAndDissipation) {
  double const inertia = 0.05, viscous = 0.2, coulomb = 0.1;
  JointPlant const joint(plant({{"inertia", inertia}, {"viscous", viscous}, {"coulomb", coulomb}}));
  JointState state;
  double work = 0.0, dissipated = 0.0;
  constexpr double step_s = 20e-6;
  for (int i = 0; i < 100000; ++i) {
    double const u = std::sin(6.0 * state.time_s);
    JointState const next = joint.advance(state, u, step_s);
    double const moved = next.q - state.q, speed = 0.5 * (state.dq + next.dq);
    work += u * moved;
    dissipated += viscous * speed * moved + coulomb * std::abs(moved);
    state = next;
  }
  EXPECT_GT(work, 0.1);
  EXPECT_NEAR(work - dissipated, 0.5 * inertia * state.dq * state.dq, 1e-6 * work);
}

TEST(JointPlant, InverseDynamicsGivesTheAcceleration) {
  JointPlant const joint(plant({{"inertia", 0.1},
                                {"viscous", 0.3},
                                {"gravity_sin", 2.0},
                                {"gravity_cos", -1.0},
                                {"coulomb", 0.4},
                                {"offset", 0.07}}));
  for (double dq : {-1.3, 0.6}) {
    JointState state{0.0, 0.8, dq, 0.0};
    state.ddq = joint.acceleration(state, 1.7);
    EXPECT_NEAR(joint.inverse_dynamics(state), 1.7, 1e-14);
  }
}

TEST(JointPlant, StartsAgainTheOtherWayWithinOneStep) {
  JointPlant const joint(plant({{"inertia", 1.0}, {"coulomb", 1.0}}));
  // brakes with -(3 + 1) for 0.25 s, then accelerates with -(3 - 1) for 0.75 s
  JointState const end = joint.advance({0.0, 0.0, 1.0, 0.0}, -3.0, 1.0);
  EXPECT_DOUBLE_EQ(end.dq, -2.0 * 0.75);
  EXPECT_DOUBLE_EQ(end.q, 0.5 * 0.25 - 0.5 * 2.0 * 0.75 * 0.75);
}

}  // namespace joint_plant_test
