// What hangs on the joint keeps or takes energy as it should; what pushes and drives it has its hand-computed values.
#include <gtest/gtest.h>

#include "concealed/imposed_motion.hpp"

namespace concealed {
namespace structure_laws_test {

constexpr double two_pi = 2.0 * std::numbers::pi;

TEST(ConcealedStructure, RopeIsSlackNearItsRestAndPullsBeyond) {
  RopeDesign const design{8.0, 0.6, 0.65, 0.1, 0.0, 0.1};
  auto const slack = rope(design);
  double z = 0.0;
  double const taut_at = std::sqrt(0.65 * 0.65 - 0.6 * 0.6);
  EXPECT_EQ(slack->torque({0.0, 0.1 + 0.99 * taut_at, 0.0, 0.0, 0}, &z), 0.0);
  double const length = std::hypot(0.6, 0.8);
  EXPECT_NEAR(slack->torque({0.0, 0.9, 0.0, 0.0, 0}, &z), 8.0 * (length - 0.65) * 0.8 / length, 1e-14);
  // without rubbing a spring: potential energy of the rope, stiffness/2 (length - slack)^2
  auto stored = [](State const& s) {
    double const pulled = std::max(0.0, std::hypot(0.6, s.q() - 0.1) - 0.65);
    return 4.0 * pulled * pulled;
  };
  EXPECT_LT(energy_drift(rope(design), 0.1, stored), 1e-7);
  RopeDesign rubbing = design;
  rubbing.rub = 0.2;
  EXPECT_GT(work_over(*rope(rubbing), 0.5, 1.0, 1.0, 2.0), 0.0);
}

TEST(ConcealedStructure, StopPushesBackBeyondItsPlaceOnly) {
  auto const stop = hard_stop(0.3, 50.0, 0.2);
  EXPECT_EQ(stop->torque({0.0, 0.29, 1.0, 0.0, 1}, nullptr), 0.0);
  EXPECT_EQ(stop->torque({0.0, -0.9, 1.0, 0.0, 1}, nullptr), 0.0);
  EXPECT_NEAR(stop->torque({0.0, 0.34, 0.5, 0.0, 1}, nullptr), 50.0 * 0.008 * 1.1, 1e-14);
  EXPECT_GE(stop->torque({0.0, 0.34, -9.0, 0.0, -1}, nullptr), 0.0);
  EXPECT_GT(work_over(*stop, 0.5, 1.0, 0.0, 1.0), 0.0);
  EXPECT_NEAR(work_over(*hard_stop(0.3, 50.0, 0.0), 0.5, 1.0, 0.0, 1.0), 0.0, 1e-6);
}

TEST(ConcealedStructure, GearErrorKeepsTheEnergyOfTheLinkItMoves) {
  double const a = 0.004, n = 12.0, link = 0.07, weight = 0.3;
  auto const gear = gear_error(a, n, 0.2, 0.0, {link, weight, 0.0});
  // energy_drift counts the whole inertia at the motor's speed: the rest is that the link turns by 1 + h'
  auto rest = [=](State const& s) {
    double const x = n * s.q() + 0.2, y = 2.0 * x + 0.9;
    double const h = a * (std::sin(x) + 0.35 * std::sin(y)), k = 1.0 + a * n * (std::cos(x) + 0.7 * std::cos(y));
    return 0.5 * link * (k * k - 1.0) * s.v() * s.v() + weight * (std::cos(s.q()) - std::cos(s.q() + h)) + 1.0;
  };
  EXPECT_LT(energy_drift(gear, 0.1, rest), 1e-8);
}

TEST(ConcealedStructure, FlexibleGearKeepsTheEnergyWithoutDamping) {
  double const load = 0.04, stiffness = 60.0, knee = 0.02;
  auto stored = [=](State const& s) {
    double const w = s.q() - s.y[2];
    return 0.5 * load * s.y[3] * s.y[3] + 0.5 * stiffness * w * w * (1.0 + 0.5 * w * w / (knee * knee));
  };
  EXPECT_LT(energy_drift(flexible_gear(load, stiffness, knee, 0.0), 0.1, stored), 1e-9);
}

TEST(ConcealedStructure, PickedUpLoadSlowsTheJointFromItsTimeOn) {
  Baseline baseline;
  baseline.inertia = 0.1;
  Plant const plant(baseline, {picked_up_load(1.0, {0.06, 0.0, 0.5})});
  State state = plant.at_rest(0.0);
  Drive const drive{.motor = 2.0};
  EXPECT_NEAR(plant.acceleration(state, drive), 20.0, 1e-12);
  state.t = 5.0;
  EXPECT_NEAR(plant.acceleration(state, drive), (2.0 - 0.5) / 0.16, 1e-12);
  EXPECT_NEAR(plant.added_torque(0, state, drive), 0.5 + 0.06 * 1.5 / 0.16, 1e-12);
}

TEST(ConcealedStructure, PushPeaksWhereItSaysAndHumIsPeriodic) {
  auto const touch = push(0.7, 3.0, 0.2);
  EXPECT_EQ(touch->torque({2.9, 0.0, 0.0, 0.0, 0}, nullptr), 0.0);
  EXPECT_NEAR(touch->torque({3.2, 0.0, 0.0, 0.0, 0}, nullptr), 0.7, 1e-12);
  for (double t : {3.1, 3.5, 6.0}) EXPECT_LT(touch->torque({t, 0.0, 0.0, 0.0, 0}, nullptr), 0.7);
  auto const machine = hum(0.2, 4.0, 0.3);
  EXPECT_NEAR(machine->torque({1.1, 0.5, 1.0, 0.0, 1}, nullptr), 0.2 * std::sin(two_pi * 4.4 + 0.3), 1e-12);
  EXPECT_NEAR(machine->torque({1.1, 0.0, 0.0, 0.0, 0}, nullptr), machine->torque({1.35, 0.0, 0.0, 0.0, 0}, nullptr),
              1e-12);
}

TEST(ConcealedStructure, HiddenShaftIsNeitherAFunctionOfTimeNorOfTheAngle) {
  auto const shaft = hidden_shaft(0.2, 2.0, 5.0);
  double z = 1.0, still = 0.0, moving = 0.0;
  shaft->rates({0.0, 0.3, 0.0, 0.0, 0}, &z, &still);
  shaft->rates({0.0, 0.3, 0.4, 0.0, 1}, &z, &moving);
  EXPECT_NEAR(still, two_pi * 2.0, 1e-12);
  EXPECT_NEAR(moving - still, 2.0, 1e-12);
  EXPECT_NEAR(shaft->torque({7.0, 0.1, 0.0, 0.0, 0}, &z), 0.2 * (std::sin(1.0) + 0.3 * std::sin(2.0)), 1e-15);
}

// the drive records now.motor
Instant driven(double motor, double q = 0.0, double v = 0.0) { return {0.0, q, v, 0.0, v > 0.0 ? 1 : -1, motor}; }

TEST(ConcealedDrive, SupplySagFollowsThePowerOfAWhileAgo) {
  auto const supply = supply_sag(0.5, 40.0, 0.8);
  double sag = 0.2, rate = 1.0;
  supply->rates(driven(4.0, 0.0, 2.0), &sag, &rate);
  EXPECT_NEAR(rate, 0.0, 1e-15);
  EXPECT_NEAR(supply->torque(driven(4.0), &sag), 0.4, 1e-15);
  EXPECT_NEAR(supply->torque(driven(-4.0), &sag), -0.4, 1e-15);
}

TEST(ConcealedDrive, RippleScalesWithTheTorqueAndMeansNothingOverATurn) {
  auto const motor = torque_ripple(0.1, 8.0, 0.4);
  EXPECT_NEAR(motor->torque(driven(6.0, 0.3), nullptr), -2.0 * motor->torque(driven(-3.0, 0.3), nullptr), 1e-15);
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) sum += motor->torque(driven(5.0, two_pi * i / 1000.0), nullptr);
  EXPECT_NEAR(sum / 1000.0, 0.0, 1e-12);
}

TEST(ConcealedDrive, SaturationTakesLittleBelowTheKneeAndThirtyPerCentThere) {
  auto const iron = saturation(10.0);
  EXPECT_NEAR(iron->torque(driven(10.0), nullptr), 10.0 * (1.0 - std::sqrt(0.5)), 1e-14);
  EXPECT_NEAR(iron->torque(driven(-1.0), nullptr), -0.5 * 1e-2, 1e-4);
}

TEST(ConcealedDrive, CurrentLoopFollowsARampLate) {
  double const late_s = 0.004;
  auto const loop = current_loop(late_s, 0.7);
  double z[2] = {0.0, 0.0}, rate[2];
  double const dt = 1e-6;
  for (int i = 0; i < 100000; ++i) {
    loop->rates(driven(30.0 * i * dt), z, rate);
    for (int j = 0; j < 2; ++j) z[j] += dt * rate[j];
  }
  EXPECT_NEAR(loop->torque(driven(3.0), z), 30.0 * late_s, 1e-4);
}

}  // namespace structure_laws_test
}  // namespace concealed
