// Each hidden effect does what its name says: conserves, dissipates, remembers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "concealed/imposed_motion.hpp"

namespace concealed {
namespace effect_laws_test {

constexpr double step_s = law_step_s;

TEST(ConcealedEffects, PotentialsKeepTheEnergy) {
  double const n = 22.0;
  auto cogging_potential = [&](State const& s) {
    double const x = n * s.q() + 0.3;
    return -0.04 / n * (std::cos(x) + 0.225 * std::cos(2.0 * x + 0.7) + 0.25 / 3.0 * std::cos(3.0 * x + 2.1));
  };
  EXPECT_LT(energy_drift(cogging(0.04, n, 0.3), 0.1, cogging_potential), 1e-9);
  EXPECT_LT(energy_drift(gravity(0.8, 0.5), 0.1, [](State const& s) { return 2.0 - 0.8 * std::cos(s.q() - 0.5); }),
            1e-9);
  auto spring_potential = [](State const& s) {
    double const x = s.q() - 0.2;
    return 0.5 * 1.5 * x * x * (1.0 + 0.5 * 0.3 * x * x);
  };
  EXPECT_LT(energy_drift(hardening_spring(1.5, 0.2, 0.3), 0.1, spring_potential), 1e-9);
}

TEST(ConcealedEffects, TwoMassesWithoutDampingKeepTheEnergy) {
  double const limit = 0.2, omega = 2.0 * std::numbers::pi * 1.1, liquid = 0.02;
  auto tank = [&](State const& s) {
    double const x = (s.q() - s.y[2]) / limit;
    return 0.5 * liquid * s.y[3] * s.y[3] + liquid * omega * omega * limit * limit * std::log(std::cosh(x));
  };
  EXPECT_LT(energy_drift(sloshing_load(liquid, 1.1, 0.0, limit), 0.1, tank), 1e-9);

  double const load = 0.04, half_gap = 0.002, stiffness = 1500.0;
  auto gear = [&](State const& s) {
    double const depth = std::max(0.0, std::abs(s.q() - s.y[2]) - half_gap);
    return 0.5 * load * s.y[3] * s.y[3] + 0.5 * stiffness * depth * depth;
  };
  // a step that straddles a corner of the force errs by at most (step * frequency of the contact)^2 of the energy
  double const contact = step_s * std::sqrt(stiffness * (1.0 / load + 1.0 / 0.06));
  EXPECT_LT(energy_drift(backlash(load, half_gap, stiffness, 0.0), 0.1, gear), contact * contact);
}

TEST(ConcealedEffects, FrictionTakesEnergyInEveryClosedMotion) {
  Effect const frictions[] = {lorentzian_stribeck(0.1, 0.1), rational_stribeck(0.1, 0.1),
                              warm_up(0.8, 0.6, 0.1, 1.0, 9.0), load_friction(0.05, 0.1, {0.1, 0.5, 0.0}),
                              memory_drag(0.3, 0.5, 2.0, 0.05)};
  for (auto const& friction : frictions) {
    for (double period_s : {0.2, 1.0}) EXPECT_GT(work_over(*friction, 0.4, period_s, 1.0, 2.0), 0.0);
  }
}

TEST(ConcealedEffects, PreslidingTakesLittleInSmallStrokesAndNearlyAllOfCoulombInLongOnes) {
  double const coulomb = 0.8, stiffness = 800.0;  // half of the level after 1 mrad
  auto const bristle = bristle_presliding(coulomb, stiffness);
  // taking the Coulomb friction it stands in for out again: work of the bristle alone
  auto loop_work = [&](double reach) { return work_over(*bristle, reach, 1.0, 2.0, 3.0) + 4.0 * coulomb * reach; };
  EXPECT_GT(loop_work(1e-4), 0.0);
  EXPECT_LT(loop_work(1e-4), 0.1 * 4.0 * coulomb * 1e-4);
  EXPECT_GT(loop_work(0.5), 0.97 * 4.0 * coulomb * 0.5);
  EXPECT_LT(loop_work(0.5), 4.0 * coulomb * 0.5);
}

TEST(ConcealedEffects, HaveTheShapesTheyAreNamedAfter) {
  Instant const now{7.0, 0.0, 0.1, 0.0, 1};
  EXPECT_NEAR(lorentzian_stribeck(0.3, 0.1)->dry(now, nullptr), 0.3 / 2.0, 1e-15);
  EXPECT_NEAR(rational_stribeck(0.3, 0.1)->dry(now, nullptr), 0.3 / 4.0, 1e-15);
  EXPECT_NEAR(asymmetric_viscous(0.2)->torque(now, nullptr), 0.02, 1e-15);
  double const cold = 0.6 * std::exp(-7.0 / 40.0) + 0.4 * std::exp(-7.0 / 160.0);
  EXPECT_NEAR(warm_up(0.9, 0.7, 0.1, 40.0, 160.0)->dry(now, nullptr), 0.09 * cold, 1e-15);
  EXPECT_NEAR(warm_up(0.9, 0.7, 0.1, 40.0, 160.0)->torque(now, nullptr), 0.07 * cold * 0.1, 1e-15);

  // from rest the bristle reaches x / (1 + x) of its level, x = stiffness * distance / level
  auto const bristle = bristle_presliding(0.8, 800.0);
  double z = 0.0, rate = 0.0;
  double const dt = 1e-6;
  for (int i = 0; i < 30000; ++i) {
    bristle->rates(now, &z, &rate);
    z += dt * rate;
  }
  EXPECT_NEAR(z / 0.8, 3.0 / 4.0, 1e-4);
}

TEST(ConcealedEffects, PreslidingDoesNotDependOnTheRate) {
  auto const bristle = bristle_presliding(0.8, 800.0);
  EXPECT_NEAR(work_over(*bristle, 0.01, 1.0, 2.0, 3.0), work_over(*bristle, 0.01, 0.25, 2.0, 3.0), 1e-5);
}

TEST(ConcealedEffects, BacklashLetsTheMotorMoveByTheGapWithoutTheLoad) {
  Baseline baseline;
  baseline.inertia = 0.1;
  auto const gear = backlash(0.04, 0.01, 1500.0, 100.0);
  Plant const plant(baseline, {gear});
  State state = plant.at_rest(0.0);
  state.y[1] = 0.5;
  while (state.q() < 0.0099) plant.advance(state, {}, step_s);
  EXPECT_EQ(state.v(), 0.5);
  EXPECT_EQ(state.y[2], 0.0);
  // and after the blows both share the momentum
  for (int i = 0; i < 250000; ++i) plant.advance(state, {}, step_s);
  EXPECT_NEAR(0.06 * state.v() + 0.04 * state.y[3], 0.06 * 0.5, 1e-12);
}

TEST(ConcealedEffects, MemoryDragDependsOnWhatWentBefore) {
  auto const fluid = memory_drag(0.3, 0.5, 2.0, 0.05);
  double rested = 1.0, shaken = 0.2;
  Instant const now{0.0, 0.0, 0.4, 0.0, 1};
  EXPECT_GT(fluid->torque(now, &rested), 10.0 * fluid->torque(now, &shaken));
}

TEST(ConcealedEffects, LoadFrictionSolvesItsOwnEquation) {
  Baseline const baseline{.inertia = 0.7, .viscous = 2.0, .coulomb = 3.0, .gravity_sin = 7.0};
  Link const link{0.6, 7.0, 0.0};
  Plant const plant(baseline, {load_friction(0.1, 0.5, link)});
  for (double v : {-0.5, 0.5}) {
    for (double motor : {-12.0, 4.0, 20.0}) {
      State state = plant.at_rest(0.8);
      state.y[1] = v;
      Drive const drive{.motor = motor};
      double const a = plant.acceleration(state, drive), side = v > 0.0 ? 1.0 : -1.0;
      double const load = 0.6 * a + 7.0 * std::sin(0.8);
      double const friction = 3.0 + 0.1 * (std::sqrt(load * load + 0.25) - 0.5);
      EXPECT_NEAR(0.7 * a + 2.0 * v + 7.0 * std::sin(0.8) + side * friction, motor, 1e-11);
    }
  }
}

}  // namespace effect_laws_test
}  // namespace concealed
