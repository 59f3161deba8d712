// Backlash: its limits (play of 2 b, elastic joint), the textbook effect, the rule for sub-steps, and the loop of a
// plant.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/effects/effect.hpp"

namespace torquescope {
namespace backlash_effects_test {

JointScales const plain;

// a motor that swings and is driven against its load by two sines; states at any instant
JointState swinging(double t) {
  constexpr double slow = 7.0, fast = 31.0;
  return {t, 0.3 * std::sin(slow * t) + 0.01 * std::sin(fast * t),
          0.3 * slow * std::cos(slow * t) + 0.01 * fast * std::cos(fast * t),
          -0.3 * slow * slow * std::sin(slow * t) - 0.01 * fast * fast * std::sin(fast * t)};
}

TEST(Backlash, HasAPlayOfExactlyTwoB) {
  // pushed forwards for long, then braked: the load flies across the gap at the acceleration of the motor
  double const half_gap = 2.5e-3, braking = 10.0, step_s = 1e-4;
  auto const runner = find_effect("backlash")->runner(std::vector<double>{1.0, half_gap, 2000.0, 0.1, 0.0, 0.0}, plain);
  runner->advance({.ddq = braking}, 0.0);
  EXPECT_NEAR(runner->torque({.ddq = braking}), 0.0, 1e-9);
  JointState const braked{.ddq = -braking};
  double flight_s = 0.0;
  for (; flight_s < 5e-4; flight_s += step_s) runner->advance(braked, step_s);  // the flank lets go
  for (; flight_s < 1.0 && runner->torque(braked) == braking; flight_s += step_s) runner->advance(braked, step_s);
  // the flank gave the load a speed of up to 2 braking / w, which it has all the way
  double const expected = std::sqrt(2.0 * 2.0 * half_gap / braking),
               pushed_off = 2.0 / (2.0 * std::numbers::pi * 2000.0);
  EXPECT_NEAR(flight_s, expected, pushed_off + 3.0 * step_s);
}

TEST(Backlash, AThinFilmChangesNothingAndAThickOneHoldsTheLoadBack) {
  // the load comes to rest in the grease of a gap without end: y'' = -c y', from the speed that the motor lost
  double const film_per_s = 40.0, lost = 0.5, step_s = 1e-5;
  auto const speed_after = [&](double film, double time_s) {
    auto const runner = find_effect("backlash")->runner(std::vector<double>{1.0, 1e3, 50.0, 0.1, film, 0.0}, plain);
    runner->advance({.ddq = 0.0}, 0.0);
    double left = lost, t = 0.0;
    runner->advance({.ddq = -lost / step_s}, step_s);  // half of it in this step, half in the next
    runner->advance({.ddq = 0.0}, step_s);
    for (; t < time_s; t += step_s) left += step_s * runner->torque({.ddq = 0.0}, step_s);
    return left;
  };
  EXPECT_NEAR(speed_after(0.0, 0.1), lost, 1e-12);
  EXPECT_NEAR(speed_after(1e-7, 0.1), lost, 1e-6);
  EXPECT_NEAR(speed_after(film_per_s, 0.1), lost * std::exp(-film_per_s * 0.1), 0.01 * lost);
}

TEST(Backlash, IsAnElasticJointWhileGravityHoldsTheFlank) {
  JointScales scales;
  scales.inertia = 0.4;
  scales.gravity_cos = 4.0;  // 10 rad/s2 at q = 0, more than the motion asks for
  auto const gap = find_effect("backlash")->runner(std::vector<double>{0.3, 2.5e-3, 20.0, 0.1, 5.0, 0.0}, scales);
  auto const spring = find_effect("joint_elasticity")->runner(std::vector<double>{0.3, 20.0, 0.1, 0.0}, scales);
  for (int i = 0; i < 5000; ++i) {
    double const t = 1e-3 * i;
    JointState const state{.time_s = t, .ddq = 3.0 * std::sin(20.0 * t)};
    double const step_s = i > 0 ? 1e-3 : 0.0;
    ASSERT_NEAR(gap->torque(state, step_s), spring->torque(state, step_s), 1e-10) << t;
  }
}

// q_l'' = w^2 dz(q - q_l) + 2 zeta w (dq - dq_l) in contact, never pulling, else c (dq - dq_l), in the load's own
// coordinate, less d (Fv dq_l + Fc sign(dq_l)) / J for the load's own bearings, which the rigid joint has as well;
// returns the share of the samples at which the load rests
double rest_of_a_textbook_load(JointScales const& braked) {
  double const half_gap = 2e-3, frequency_hz = 45.0, damping = 0.3, film_per_s = 30.0, drag = 1.0;
  double const drag_per_s = drag * braked.viscous / braked.inertia;
  double const forward = drag * braked.coulomb_positive / braked.inertia;
  double const backward = drag * braked.coulomb_negative / braked.inertia;
  auto const dry = [&](double speed) { return speed > 0.0 ? forward : speed < 0.0 ? -backward : 0.0; };
  double const omega = 2.0 * std::numbers::pi * frequency_hz;
  auto const runner = find_effect("backlash")
                          ->runner(std::vector<double>{1.0, half_gap, frequency_hz, damping, film_per_s, drag}, braked);
  constexpr int finer = 2000;
  constexpr double step_s = 1e-3;
  auto const start = swinging(0.1);
  double const pushed = start.ddq + drag_per_s * start.dq + dry(start.dq);
  double q_load = start.q - std::copysign(half_gap, pushed) - pushed / (omega * omega), dq_load = start.dq;
  double difference = 0.0, size = 0.0;
  int free_samples = 0, resting_samples = 0;
  runner->advance(start, 0.0);
  for (int i = 1; i <= 3000; ++i) {
    double push = 0.0;
    bool touches = false;
    for (int k = 1; k <= finer; ++k) {
      auto const now = swinging(0.1 + step_s * (i - 1 + static_cast<double>(k) / finer));
      double const apart = now.q - q_load, side = std::copysign(1.0, apart);
      double const deep = apart - side * half_gap;
      push = side * deep > 0.0 ? omega * omega * deep + 2.0 * damping * omega * (now.dq - dq_load) : 0.0;
      touches = side * push > 0.0;
      if (!touches) push = film_per_s * (now.dq - dq_load);
      dq_load += (push - drag_per_s * dq_load) * step_s / finer;
      double const taken = (dq_load > 0.0 ? forward : backward) * step_s / finer;
      dq_load = std::copysign(std::max(std::abs(dq_load) - taken, 0.0), dq_load);
      q_load += dq_load * step_s / finer;
    }
    auto const state = swinging(0.1 + step_s * i);
    double const expected = push - state.ddq - drag_per_s * state.dq - dry(state.dq);
    difference += std::pow(runner->torque(state, step_s) - expected, 2);
    size += expected * expected;
    free_samples += touches ? 0 : 1;
    resting_samples += dq_load == 0.0 ? 1 : 0;
  }
  EXPECT_GT(free_samples, 100);
  EXPECT_LT(std::sqrt(difference / size), 0.01);
  return resting_samples / 3000.0;
}

TEST(Backlash, ObeysTheTextbookEffectInTinySteps) {
  JointScales braked;
  braked.inertia = 2.0;
  braked.viscous = 8.0;
  EXPECT_EQ(rest_of_a_textbook_load(braked), 0.0);
  // held by its bearings while the motor crosses the gap
  braked.coulomb_positive = 20.0;
  braked.coulomb_negative = 28.0;
  EXPECT_GT(rest_of_a_textbook_load(braked), 0.01);
}

TEST(Backlash, DoesNotCareHowASampleIsCutUp) {
  double const step_s = 1e-3;
  for (double const frequency_hz : {10.0, 60.0, 180.0}) {
    std::vector<double> const parameters{1.0, 1e-3, frequency_hz, 0.2, 30.0, 0.5};
    auto const whole = find_effect("backlash")->runner(parameters, plain);
    auto const cut = find_effect("backlash")->runner(parameters, plain);
    double difference = 0.0, size = 0.0, before = swinging(0.0).ddq;
    whole->advance(swinging(0.0), 0.0), cut->advance(swinging(0.0), 0.0);
    for (int i = 1; i <= 2000; ++i) {
      auto state = swinging(step_s * i);
      double const after = state.ddq, at_once = whole->torque(state, step_s);
      constexpr int pieces = 32;
      for (int k = 1; k <= pieces; ++k) {
        state.ddq = before + (after - before) * k / pieces;
        cut->advance(state, step_s / pieces);
      }
      difference += std::pow(cut->torque(state) - at_once, 2);
      size += at_once * at_once;
      before = after;
    }
    EXPECT_LT(std::sqrt(difference / size), 1e-3) << frequency_hz;
  }
}

// As a plant holds it, its part that goes with the acceleration among the inertia: after a push that reaches the motor
// alone the load rattles in the gap until both go at the speed that the push gave to their sum. With that part taken at
// the acceleration of the step before, a load of nine tenths runs away at these steps.
TEST(Backlash, TakesTheLoadAlongInALoop) {
  double const inertia = 0.1, push = 5.0, pushed_s = 0.01, step_s = 1e-4;
  for (double const share : {0.1, 0.5, 0.9}) {
    auto const runner =
        find_effect("backlash")->runner(std::vector<double>{share * inertia, 1e-3, 60.0, 0.3, 20.0, 0.0}, plain);
    JointState motor{};
    runner->advance(motor, 0.0);
    double const together = push * pushed_s / inertia;
    double fastest = 0.0, swing = 0.0;
    auto const steps = static_cast<int>(std::lround(6.0 / step_s));
    for (int i = 0; i < steps; ++i) {
      runner->advance(motor, step_s);
      motor.ddq = 0.0;
      double const coasting = std::as_const(*runner).torque(motor);
      motor.ddq = 1.0;
      double const taken = coasting - std::as_const(*runner).torque(motor);
      motor.ddq = ((i < std::lround(pushed_s / step_s) ? push : 0.0) - coasting) / (inertia - taken);
      motor.dq += motor.ddq * step_s;
      motor.q += motor.dq * step_s;
      fastest = std::max(fastest, std::abs(motor.dq));
      if (i > steps / 6 * 5) swing = std::max(swing, std::abs(motor.dq - together));
    }
    EXPECT_LT(fastest, 1.05 * together / (1.0 - share)) << share;  // the whole push in the motor
    EXPECT_LT(swing, 0.05 * together) << share;
  }
}

// a tenth of what the flank winds up: 0.1 (2 / 0.5) / (2 pi 20)^2 = 2.53e-5 rad
TEST(Backlash, IsNoneWhereTheFlankWindsUpTenTimesAsFar) {
  JointScales scales;
  scales.torque_rms = 2.0;
  scales.inertia = 0.5;
  auto const is_gap = [&](double half_gap, double frequency_hz) {
    return find_effect("backlash")->is_plausible(std::array{half_gap, frequency_hz, 0.1, 5.0, 0.01}, scales);
  };
  EXPECT_TRUE(is_gap(2.6e-5, 20.0));
  EXPECT_FALSE(is_gap(2.5e-5, 20.0));
  EXPECT_FALSE(is_gap(2.6e-5, 19.0));
  EXPECT_TRUE(is_gap(2.5e-5, 21.0));
}

}  // namespace backlash_effects_test
}  // namespace torquescope
