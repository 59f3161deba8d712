// Hidden frictions of speed, history, place, load and time: hand-computed values, limits, energy.
#include <gtest/gtest.h>

#include "concealed/imposed_motion.hpp"

namespace concealed {
namespace friction_laws_test {

Instant sliding(double v, double t = 0.0) { return {t, 0.0, v, 0.0, v > 0.0 ? 1 : -1}; }

TEST(ConcealedFriction, OfSpeedHasItsHandComputedValues) {
  EXPECT_NEAR(speed_drag(0.3)->torque(sliding(-2.0), nullptr), -1.2, 1e-15);
  auto const grease = shear_thinning(0.7, 0.1, 0.4);
  EXPECT_NEAR(grease->torque(sliding(1e-6), nullptr), 0.7e-6, 1e-15);
  EXPECT_NEAR(grease->torque(sliding(0.1), nullptr), 0.07 * std::pow(2.0, -0.3), 1e-15);
  // far above the knee a power law: ten times the speed, 10^0.4 times the torque
  double const ratio = grease->torque(sliding(100.0), nullptr) / grease->torque(sliding(10.0), nullptr);
  EXPECT_NEAR(ratio, std::pow(10.0, 0.4), 1e-3);
}

TEST(ConcealedFriction, LagVanishesAtConstantSpeedAndTurnsWithTheAcceleration) {
  auto const film = lagging_friction(0.5, 0.2, 0.04, 0.02);
  double const settled = 0.3;
  EXPECT_EQ(film->dry(sliding(0.3), &settled), 0.0);
  // speeding up, the film is that of a lower speed: more friction; slowing down, less
  EXPECT_NEAR(film->dry(sliding(0.6), &settled), 0.5 * (1.0 / 6.25 - 1.0 / 16.0), 1e-15);
  EXPECT_LT(film->dry(sliding(0.1), &settled), 0.0);
  double rate = 0.0;
  film->rates(sliding(0.6), &settled, &rate);
  EXPECT_NEAR(rate, 0.3 / 0.04, 1e-12);
  film->rates(sliding(0.1), &settled, &rate);
  EXPECT_NEAR(rate, -0.2 / 0.02, 1e-12);
}

TEST(ConcealedFriction, SlipElementsHoldTheirWholeStrengthInLongStrokesAtAnyRate) {
  double const strength = 0.4, distance = 0.01;
  auto const elements = slip_elements(strength, distance);
  // the Coulomb friction they stand in for taken out again
  auto loop_work = [&](double reach, double period_s) {
    return work_over(*elements, reach, period_s, 2.0, 3.0) + 4.0 * strength * reach;
  };
  EXPECT_GT(loop_work(0.5, 1.0), 0.96 * 4.0 * strength * 0.5);
  EXPECT_LT(loop_work(0.5, 1.0), 4.0 * strength * 0.5);
  EXPECT_GT(loop_work(2e-4, 1.0), 0.0);
  EXPECT_LT(loop_work(2e-4, 1.0), 0.2 * 4.0 * strength * 2e-4);
  EXPECT_NEAR(loop_work(0.02, 1.0), loop_work(0.02, 0.25), 1e-5);
}

TEST(ConcealedFriction, BondGrowsWithTheLogarithmOfTheRestAndTearsOverADistance) {
  auto const bond = resting_bond(0.2, 0.05, 0.004);
  double age = 2.0, rate = 0.0;
  EXPECT_NEAR(bond->dry(sliding(0.1), &age), 0.2 * std::log(41.0), 1e-15);
  Instant const rest{};
  bond->rates(rest, &age, &rate);
  EXPECT_EQ(rate, 1.0);
  // 12 mm of way, whatever the speed: exp(-3) of the age is left
  for (double v : {0.1, 0.4}) {
    double left = 2.0;
    double const dt = 1e-6;
    for (long i = 0; i < std::lround(0.012 / v / dt); ++i) {
      bond->rates(sliding(v), &left, &rate);
      left += dt * rate;
    }
    EXPECT_NEAR(left, 2.0 * std::exp(-3.0), 1e-3);
  }
}

TEST(ConcealedFriction, TightSpotsStayWhereTheyAre) {
  auto const spots = tight_spots(0.3, 5.0, 0.4);
  for (double q : {-0.7, 0.0, 1.1}) {
    Instant const forth{0.0, q, 0.5, 0.0, 1}, back{9.0, q, -0.1, 0.0, -1};
    EXPECT_EQ(spots->dry(forth, nullptr), spots->dry(back, nullptr));
    double const x = 5.0 * q + 0.4;
    EXPECT_NEAR(spots->dry(forth, nullptr), 0.3 * (std::sin(x) + 0.35 * std::sin(2.0 * x + 1.1)), 1e-15);
  }
}

TEST(ConcealedFriction, GearTakesOneShareDrivingAndAnotherDriven) {
  auto const gear = gear_losses(0.05, 0.12, 0.3, {1.0, 0.0, 0.0});
  auto loss = [&](double a, int direction) {
    Instant const now{0.0, 0.0, 0.2 * direction, a, direction};
    return gear->dry(now, nullptr);
  };
  EXPECT_NEAR(loss(10.0, 1), 0.5, 1e-9);
  EXPECT_NEAR(loss(-10.0, -1), 0.5, 1e-9);
  EXPECT_NEAR(loss(-10.0, 1), 1.2, 1e-9);
  EXPECT_NEAR(loss(10.0, -1), 1.2, 1e-9);
  EXPECT_EQ(loss(0.0, 1), 0.0);
  for (double a : {-0.2, -0.01, 0.01, 0.2}) EXPECT_GT(loss(a, 1), 0.0);
}

TEST(ConcealedFriction, WandersFromZeroByStepsOfItsAmplitude) {
  auto const drift = wandering_friction(0.02, 5), same = wandering_friction(0.02, 5),
             other = wandering_friction(0.02, 6);
  EXPECT_EQ(drift->dry(sliding(0.1, 0.0), nullptr), 0.0);
  double squares = 0.0, apart = 0.0;
  int const n = 150;
  for (int i = 0; i < n; ++i) {
    double const t = 3.0 * i, here = drift->dry(sliding(0.1, t), nullptr);
    double const step = drift->dry(sliding(0.1, t + 3.0), nullptr) - here;
    EXPECT_NEAR(drift->dry(sliding(0.1, t + 1.5), nullptr), here + 0.5 * step, 1e-12);
    EXPECT_EQ(here, same->dry(sliding(0.1, t), nullptr));
    apart = std::max(apart, std::abs(here - other->dry(sliding(0.1, t), nullptr)));
    squares += step * step;
  }
  EXPECT_NEAR(squares / n, 4e-4, 5.0 * 4e-4 * std::sqrt(2.0 / n));
  EXPECT_GT(apart, 0.02);
}

}  // namespace friction_laws_test
}  // namespace concealed
