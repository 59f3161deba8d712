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

Baseline sticky(StickingLaw law) {
  Baseline baseline{.inertia = 0.1, .viscous = 0.6, .coulomb = 0.9};
  baseline.sticking = law;
  return baseline;
}

TEST(ConcealedPlant, CreepsInProportionToWhatPushesIt) {
  Plant const plant(sticky({Sticking::creep, 0.002, 0.0}), {});
  State const end = after(plant, plant.at_rest(0.3), {.motor = 0.45}, 0.2, step_s);
  double const level_per_speed = 0.9 / 0.002 + 0.6;
  EXPECT_NEAR(end.v(), 0.45 / level_per_speed, 1e-12);
}

TEST(ConcealedPlant, BristlesBendBeforeTheySlide) {
  double const length = 1e-4;
  Plant const plant(sticky({Sticking::bristle, 0.0, length}), {});
  State bent = plant.at_rest(0.0);
  int const parts = 1000;
  for (int i = 1; i <= parts; ++i) bent = after(plant, bent, {.motor = 0.3 * i / parts}, 1e-3, step_s);
  // dz = (1 - z / D) dq up to z = D / 3
  EXPECT_NEAR(bent.q(), -length * std::log(1.0 - 1.0 / 3.0), 0.01 * length);
  State const slid = after(plant, bent, {.motor = 2.1}, 2.0, step_s);
  EXPECT_NEAR(slid.v(), 2.0, 1e-4);
}

TEST(ConcealedPlant, RestsWithinItsBandAndSlidesLikeCoulomb) {
  Plant const band(sticky({Sticking::band, 1e-3, 0.0}), {}), at_once(sticky({}), {});
  State slow = moving(band, 0.0, 0.9e-3);
  EXPECT_EQ(band.direction(slow, {.motor = 0.5}), 0);
  band.advance(slow, {.motor = 0.5}, step_s);
  EXPECT_EQ(slow.v(), 0.0);
  EXPECT_EQ(band.direction(slow, {.motor = 1.0}), 1);
  State const start = moving(band, 0.0, 2.0);
  EXPECT_EQ(after(band, start, {.motor = 0.5}, 0.1, step_s).q(),
            after(at_once, start, {.motor = 0.5}, 0.1, step_s).q());
}

TEST(ConcealedPlant, HoldsAtOnceInTheLimitOfSlowCreepAndShortBristles) {
  Drive const back{.motor = -3.0};
  auto const end = [&](StickingLaw law) {
    Plant const plant(sticky(law), {});
    return after(plant, moving(plant, 0.0, 2.0), back, 0.5, step_s).q();
  };
  double const held = end({});
  auto const apart = [&](StickingLaw law) { return std::abs(end(law) - held); };
  double const creeping = apart({Sticking::creep, 1e-3, 0.0}), bending = apart({Sticking::bristle, 0.0, 1e-5});
  EXPECT_LT(creeping, 1e-4);
  // while bristles turn over they give back up to 2 level D; the speed of that for the rest of the time
  EXPECT_LT(bending, 0.5 * std::sqrt(4.0 * 0.9 * 1e-5 / 0.1));
  EXPECT_LT(apart({Sticking::creep, 1e-4, 0.0}), 0.3 * creeping);
  EXPECT_LT(apart({Sticking::bristle, 0.0, 1e-6}), 0.5 * bending);
}

TEST(ConcealedPlant, KnowsItsStickingLawsByName) {
  for (auto const& name : sticking_names()) {
    StickingLaw const law = sticking_named(name, 1e-4);
    EXPECT_EQ(law.kind == Sticking::at_once, name == "coulomb");
    EXPECT_EQ(law.length > 0.0, law.kind == Sticking::bristle);
  }
  EXPECT_THROW(sticking_named("glue", 0.0), std::invalid_argument);
}

TEST(ConcealedPlant, RefusesMoreStatesThanItHasRoomFor) {
  auto const tank = sloshing_load(0.01, 1.0, 0.0, 1.0);
  EXPECT_THROW(Plant(frictionless(1.0), HiddenEffects(max_states / 2, tank)), std::invalid_argument);
}

}  // namespace plant_laws_test
}  // namespace concealed
