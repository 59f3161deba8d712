// The joint obeys mechanics: energy is kept or dissipated, dry friction holds and stops, the integrator is of its
// order.
#include <gtest/gtest.h>

#include <cmath>

#include "concealed/effects/laws.hpp"
#include "concealed/plant.hpp"

namespace concealed {
namespace plant_laws_test {

constexpr double step_s = 20e-6;

Baseline frictionless(double inertia) {
  Baseline baseline;
  baseline.inertia = inertia;
  return baseline;
}

State moving(Plant const& plant, double q, double v) {
  State state = plant.at_rest(q);
  state.y[1] = v;
  return state;
}

State after(Plant const& plant, State state, Drive const& drive, double duration_s, double h) {
  auto const steps = std::lround(duration_s / h);
  for (long i = 0; i < steps; ++i) plant.advance(state, drive, h);
  return state;
}

TEST(ConcealedPlant, FallsLikeConstantAcceleration) {
  Plant const plant(frictionless(0.5), {});
  State const end = after(plant, plant.at_rest(0.0), {.motor = 2.0}, 1.0, step_s);
  EXPECT_NEAR(end.v(), 4.0, 1e-10);
  EXPECT_NEAR(end.q(), 2.0, 1e-10);
}

TEST(ConcealedPlant, CoastsToRestWhereViscousAndCoulombFrictionSay) {
  // J dv = -(f v + c) dt: rest after T = J/f ln(1 + f v0 / c), way J/f (v0 - c T / J)
  Baseline const baseline{.inertia = 0.1, .viscous = 0.6, .coulomb = 0.9};
  double const v0 = 2.0, time = 0.1 / 0.6 * std::log(1.0 + 0.6 * v0 / 0.9), way = 0.1 / 0.6 * (v0 - 0.9 * time / 0.1);
  Plant const plant(baseline, {});
  State const end = after(plant, moving(plant, 0.0, v0), {}, 0.3, step_s);
  EXPECT_EQ(end.v(), 0.0);
  EXPECT_NEAR(end.q(), way, 1e-10);
}

TEST(ConcealedPlant, RestsBelowTheCoulombLevelAndLeavesAboveIt) {
  Baseline const baseline{.inertia = 0.1, .viscous = 0.6, .coulomb = 0.9, .offset = 0.05};
  Plant const plant(baseline, {});
  for (double torque : {-0.84, 0.0, 0.94}) {
    State const end = after(plant, plant.at_rest(0.3), {.motor = torque}, 0.2, step_s);
    EXPECT_EQ(end.q(), 0.3) << torque;
    EXPECT_EQ(end.v(), 0.0) << torque;
    EXPECT_EQ(plant.direction(end, {.motor = torque}), 0) << torque;
    EXPECT_EQ(plant.acceleration(end, {.motor = torque}), 0.0) << torque;
  }
  EXPECT_GT(after(plant, plant.at_rest(0.3), {.motor = 0.96}, 0.2, step_s).q(), 0.3);
  EXPECT_LT(after(plant, plant.at_rest(0.3), {.motor = -0.86}, 0.2, step_s).q(), 0.3);
}

TEST(ConcealedPlant, DissipatesWhatFrictionTakes) {
  Baseline const baseline{.inertia = 0.1, .viscous = 0.6, .coulomb = 0.9};
  Plant const plant(baseline, {lorentzian_stribeck(0.3, 0.1)});
  State state = moving(plant, 0.0, 2.0);
  double taken = 0.0;
  auto power = [&](State const& s) {
    return s.v() == 0.0 ? 0.0 : s.v() * (0.6 * s.v() + (0.9 + 0.3 / (1.0 + 100.0 * s.v() * s.v())));
  };
  while (state.v() > 0.0) {
    double const before = power(state);
    plant.advance(state, {}, step_s);
    taken += 0.5 * step_s * (before + power(state));
  }
  // the trapezoid rule overlooks at most the last step, which ends at rest: power there times a step
  EXPECT_NEAR(taken, 0.5 * 0.1 * 4.0, 1e-7);
}

TEST(ConcealedPlant, IsOfFourthOrderOnASmoothBranch) {
  Baseline const baseline{.inertia = 0.1, .viscous = 0.1, .gravity_sin = 5.0};
  Plant const plant(baseline, {});
  State const start = moving(plant, 1.0, 0.5);
  double const exact = after(plant, start, {}, 0.2, 1e-5).q();
  double const coarse = std::abs(after(plant, start, {}, 0.2, 0.02).q() - exact);
  double const fine = std::abs(after(plant, start, {}, 0.2, 0.01).q() - exact);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.3);
}

TEST(ConcealedPlant, KeepsItsAccuracyThroughAReversal) {
  Baseline const baseline{.inertia = 0.1, .viscous = 0.6, .coulomb = 0.9};
  Plant const plant(baseline, {});
  Drive const back{.motor = -3.0};
  State const start = moving(plant, 0.0, 2.0);
  // J dv = -(F + f v + s c) dt, piecewise exponential
  auto branch = [](double v0, double push, double t) {  // velocity and way under J dv = push - f v
    double const end = push / 0.6, e = std::exp(-6.0 * t);
    return std::pair{end + (v0 - end) * e, end * t + (v0 - end) * (1.0 - e) / 6.0};
  };
  double const turn_s = std::log(1.0 + 2.0 * 0.6 / 3.9) / 6.0;
  double const way_out = branch(2.0, -3.9, turn_s).second;
  auto const [v, way_back] = branch(0.0, -2.1, 0.5 - turn_s);
  State const end = after(plant, start, back, 0.5, step_s);
  EXPECT_NEAR(end.v(), v, 1e-9);
  EXPECT_NEAR(end.q(), way_out + way_back, 1e-9);
}

TEST(ConcealedPlant, RefusesMoreStatesThanItHasRoomFor) {
  auto const tank = sloshing_load(0.01, 1.0, 0.0, 1.0);
  EXPECT_THROW(Plant(frictionless(1.0), HiddenEffects(max_states / 2, tank)), std::invalid_argument);
}

}  // namespace plant_laws_test
}  // namespace concealed
