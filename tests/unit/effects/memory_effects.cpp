// What effects with a past do.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "unit/effects/smooth_motion.hpp"

namespace torquescope {
namespace memory_effects_test {

JointScales const plain;

// moves a runner to places, one after the other, at a constant speed; the velocity is that of the step
class Walk {
 public:
  Walk(std::string const& name, std::vector<double> const& parameters, JointScales const& scales = plain)
      : runner_(find_effect(name)->runner(parameters, scales)) {
    runner_->advance({}, 0.0);
  }
  // returns the torque on arrival
  double to(double q, int steps = 1, double speed = 1.0) {
    double const step = (q - state_.q) / steps;
    for (int i = 0; i < steps; ++i) {
      double const step_s = std::abs(step) / speed;
      state_.q += step;
      state_.time_s += step_s;
      state_.dq = std::copysign(speed, step);
      runner_->advance(state_, step_s);
    }
    return torque();
  }
  double rest(double duration_s) {
    state_.dq = 0.0;
    state_.time_s += duration_s;
    runner_->advance(state_, duration_s);
    return torque();
  }
  double torque() const { return runner_->torque(state_); }
  // torque with the Coulomb friction it takes the place of: F z
  double whole(double level) const { return torque() + level * (state_.dq > 0.0 ? 1.0 : -1.0); }
  double at_speed(double dq) const {
    auto trial = state_;
    trial.dq = dq;
    return runner_->torque(trial);
  }

 private:
  std::unique_ptr<EffectRunner> runner_;
  JointState state_{};
};

TEST(Presliding, DoesNotCareAboutStepsOrSpeed) {
  Walk once("presliding", {1.0, 0.0, 0.01}), finely("presliding", {1.0, 0.0, 0.01}),
      fast("presliding", {1.0, 0.0, 0.01});
  once.to(0.004), finely.to(0.004, 1000), fast.to(0.004, 10, 50.0);
  EXPECT_NEAR(once.to(-0.003), finely.to(-0.003, 1000), 1e-13);
  EXPECT_NEAR(once.torque(), fast.to(-0.003, 7, 50.0), 1e-13);
}

TEST(Presliding, StartsAsASpringAndEndsAsCoulombFriction) {
  double const distance = 0.01, level = 0.8;
  Walk walk("presliding", {level, 0.0, distance});
  walk.to(1e-9);
  EXPECT_NEAR(walk.whole(level), level * 1e-9 / distance, 1e-14);  // stiffness F / D; Dahl's curve bends at (x / D)^2
  walk.to(distance);
  EXPECT_NEAR(walk.whole(level), level * (1.0 - std::exp(-1.0)), 1e-14);
  EXPECT_NEAR(walk.to(100.0 * distance), 0.0, 1e-12);
}

TEST(Presliding, ClosesItsLoopAndLosesEnergyInIt) {
  Walk walk("presliding", {1.0, 0.0, 0.01});
  constexpr int steps = 2000;
  constexpr double swing = 0.02;
  auto const stroke_work = [&](double from, double to) {
    double work = 0.0;
    for (int i = 1; i <= steps; ++i) {
      double const step = (to - from) / steps;
      walk.to(from + step * i);
      work += walk.whole(1.0) * step;
    }
    return work;
  };
  walk.to(swing);
  for (int i = 0; i < 20; ++i) walk.to(-swing), walk.to(swing);  // the start is forgotten by exp(-4) per stroke
  double const top = walk.whole(1.0);
  double const work = stroke_work(swing, -swing) + stroke_work(-swing, swing);
  EXPECT_NEAR(walk.whole(1.0), top, 1e-12);
  EXPECT_NEAR(top, std::tanh(swing / 0.01), 1e-12);  // fixed point of z -> 1 + (z' - 1) exp(-2 swing / D)
  EXPECT_GT(work, 0.0);
  EXPECT_LT(work, 4.0 * swing);  // Coulomb friction alone
}

TEST(Presliding, FillsTheWeakerDirectionSooner) {
  JointScales unequal;
  unequal.coulomb_positive = 0.2;
  unequal.coulomb_negative = 0.6;  // mean 0.4: sign values 0.5 and -1.5
  Walk walk("presliding", {1.0, 0.0, 0.01}, unequal);
  EXPECT_NEAR(walk.to(0.002) + 0.5, 0.5 * (1.0 - std::exp(-0.4)), 1e-14);
  walk.to(1.0);
  EXPECT_NEAR(walk.to(0.0) - 1.5, -1.5, 1e-12);
}

TEST(MaxwellSlip, RemembersThePointItTurnedAt) {
  // a small loop inside a large stroke closes on the very point, and the stroke goes on as if nothing had been
  std::vector<double> const parameters{0.4, 0.3, 0.2, 0.1, 0.01};
  Walk walk("maxwell_slip", parameters), straight("maxwell_slip", parameters);
  walk.to(0.02), walk.to(0.013, 10);
  straight.to(0.02), straight.to(0.013, 10);
  double const turned = walk.torque();
  walk.to(0.016, 7), walk.to(0.013, 7);
  EXPECT_NEAR(walk.torque(), turned, 1e-12);
  EXPECT_NEAR(walk.to(0.007, 20), straight.to(0.007, 20), 1e-12);
}

TEST(Presliding, UnlikeMaxwellSlipForgetsThePointItTurnedAt) {
  std::vector<double> const parameters{1.0, 0.0, 0.005};
  Walk walk("presliding", parameters);
  walk.to(0.02), walk.to(0.013, 10);
  double const turned = walk.torque();
  walk.to(0.016, 7), walk.to(0.013, 7);
  EXPECT_GT(std::abs(walk.torque() - turned), 0.01);
}

TEST(MaxwellSlip, StiffnessFallsAsElementsSlip) {
  Walk walk("maxwell_slip", {1.0, 1.0, 1.0, 1.0, 0.64});
  double const whole = 4.0;
  double last_slope = 1e300;
  for (double const place : {0.005, 0.02, 0.1, 0.5, 1.0}) {  // slips at 0.01, 0.04, 0.16, 0.64
    walk.to(place);
    double const here = walk.whole(whole);
    walk.to(place + 1e-4);
    double const slope = (walk.whole(whole) - here) / 1e-4;
    EXPECT_LT(slope, last_slope);
    last_slope = slope;
  }
  EXPECT_NEAR(last_slope, 0.0, 1e-9);
}

TEST(BreakawayDwell, GrowsWithTheRestAndIsRenewedBySliding) {
  double const dwell_s = 3.0, distance = 1e-3, rest_speed = 1e6, to_an_end = 0.5, without_end = 0.2;
  Walk walk("breakaway_dwell", {to_an_end, without_end, dwell_s, distance, rest_speed});
  walk.to(1.0, 100);
  walk.rest(6.0);
  EXPECT_EQ(walk.torque(), 0.0);  // at rest friction is what holds
  double const two_dwells = to_an_end * (1.0 - std::exp(-2.0)) + without_end * std::log(3.0);
  EXPECT_NEAR(walk.at_speed(1e-12), two_dwells, 1e-3);  // age at the stop was 1 ms
  EXPECT_NEAR(walk.at_speed(-1e-12), -walk.at_speed(1e-12), 1e-15);
  // sliding at 1 m/s: the age settles at D / v
  double const sliding = to_an_end * -std::expm1(-distance / dwell_s) + without_end * std::log1p(distance / dwell_s);
  EXPECT_NEAR(walk.to(1.0 + 50.0 * distance, 50), sliding, 1e-12);
}

TEST(BreakawayDwell, CountsRestsAloneWhereTheRestSpeedIsSlow) {
  double const dwell_s = 3.0, distance = 1e-3, rest_speed = 1e-3;
  Walk walk("breakaway_dwell", {1.0, 0.0, dwell_s, distance, rest_speed});
  walk.to(1.0, 100);
  walk.rest(6.0);
  EXPECT_NEAR(walk.at_speed(1e-12), 1.0 - std::exp(-2.0), 1e-3);
  // at 1 m/s a millionth of the ageing is left, which D / v of way forgets
  EXPECT_NEAR(walk.to(1.0 + 50.0 * distance, 50), 1e-6 * distance / dwell_s, 1e-12);
}

TEST(FrictionLag, SplitsTheCurveIntoTwoBranches) {
  double const lag_s = 0.02, speed = 0.1;
  auto const runner = find_effect("friction_lag")->runner(std::vector<double>{1.0, lag_s, speed, 1.0}, plain);
  auto const curve = [&](double v) { return 1.0 / (1.0 + v * v / (speed * speed)); };
  auto const velocity = [](double t) { return 0.3 + 0.25 * std::sin(3.0 * t); };
  for (int i = 0; i < 4000; ++i) {
    double const t = 0.001 * i;
    double const torque = runner->torque({.time_s = t, .dq = velocity(t)}, i > 0 ? 0.001 : 0.0);
    if (t < 0.1) continue;
    ASSERT_NEAR(torque, curve(velocity(t - lag_s)) - curve(velocity(t)), 1e-9);  // the lag is whole samples
    bool const speeds_up = velocity(t) > velocity(t - lag_s);
    ASSERT_EQ(torque > 0.0, speeds_up) << t;
  }
}

// a film that relaxes: against its differential equation in tiny steps, through a reversal, with and without dead time
TEST(FrictionLag, FollowsTheSpeedAsAStateThatRelaxes) {
  constexpr double lag_s = 0.03, speed = 0.1, step_s = 1e-3;
  constexpr int finer = 1000;
  auto const velocity = [](double t) { return t < 0.0 ? 0.3 : 0.3 * std::cos(6.0 * t); };
  auto const curve = [&](double v) { return 1.0 / (1.0 + v * v / (speed * speed)); };
  for (double const dead_share : {0.0, 1.0 / 3.0}) {
    auto const runner = find_effect("friction_lag")->runner(std::vector<double>{1.0, lag_s, speed, dead_share}, plain);
    double film_speed = 0.3;
    runner->torque({.time_s = 0.0, .dq = velocity(0.0)}, 0.0);
    for (int i = 1; i < 2000; ++i) {
      for (int k = 0; k < finer; ++k) {
        double const t = step_s * (i - 1 + (k + 0.5) / finer);
        film_speed +=
            step_s / finer * (std::abs(velocity(t - dead_share * lag_s)) - film_speed) / ((1.0 - dead_share) * lag_s);
      }
      double const t = step_s * i, v = velocity(t);
      double const expected = std::copysign(1.0, v) * (curve(film_speed) - curve(v));
      ASSERT_NEAR(runner->torque({.time_s = t, .dq = v}, step_s), expected, 2e-3) << t;
    }
  }
}

TEST(Cable, LosesEnergyInItsLoopAndNoneInItsSpring) {
  constexpr int steps = 3000;
  auto const cycle_work = [&](std::vector<double> const& parameters) {
    Walk walk("cable", parameters);
    for (int i = 0; i < 10; ++i) walk.to(0.5), walk.to(-0.5);
    double work = 0.0, before = walk.torque();
    for (double const end : {0.5, -0.5})
      for (int i = 1; i <= steps; ++i) {
        double const step = 2.0 * end / steps;
        double const now = walk.to(-end + step * i);
        work += 0.5 * (now + before) * step;
        before = now;
      }
    return work;
  };
  EXPECT_NEAR(cycle_work({2.0, -1.0, 3.0, 0.0, 0.1}), 0.0, 1e-12);
  EXPECT_GT(cycle_work({0.0, 0.0, 0.0, 1.0, 0.1}), 1.0);
  EXPECT_LT(cycle_work({0.0, 0.0, 0.0, 1.0, 0.1}), 2.0);  // a rectangle of height 2 and length 1
}

// amplitude and phase of the column under a sine of the acceleration, against the transfer function
TEST(JointElasticity, ResonatesAtTheStatedFrequency) {
  double const natural_hz = 12.0, damping = 0.05, rate_hz = 20000.0;
  auto const response = [&](double drive_hz) {
    double const omega = 2.0 * std::numbers::pi * drive_hz;
    auto const memory =
        find_effect("joint_elasticity")->runner(std::vector<double>{1.0, natural_hz, damping, 0.0}, plain);
    double sine = 0.0, cosine = 0.0;
    auto const settled = static_cast<int>(3.0 * rate_hz);                         // exp(-11) of the start is left
    auto const whole = static_cast<int>(std::lround(10.0 * rate_hz / drive_hz));  // ten periods
    for (int i = 0; i < settled + whole; ++i) {
      double const t = i / rate_hz;
      double const torque = memory->torque({.time_s = t, .ddq = std::sin(omega * t)}, i > 0 ? 1.0 / rate_hz : 0.0);
      if (i < settled) continue;
      sine += 2.0 * torque * std::sin(omega * t) / whole;
      cosine += 2.0 * torque * std::cos(omega * t) / whole;
    }
    return std::complex<double>(sine, cosine);
  };
  double const natural = 2.0 * std::numbers::pi * natural_hz;
  for (double const drive_hz : {1.0, 6.0, 12.0, 30.0}) {
    std::complex<double> const s(0.0, 2.0 * std::numbers::pi * drive_hz);
    auto const expected = -s * s / (s * s + 2.0 * damping * natural * s + natural * natural);
    // a straight line between samples misses a sine by (omega step)^2 / 12; the start by exp(-zeta omega 3 s)
    EXPECT_LT(std::abs(response(drive_hz) - expected), 2e-4 * (1.0 + std::abs(expected))) << drive_hz;
  }
  EXPECT_NEAR(std::abs(response(natural_hz)), 1.0 / (2.0 * damping), 0.01);
}

TEST(JointElasticity, StiffensAsTheTextbookEffectInTinySteps) {
  double const natural_hz = 8.0, damping = 0.05, hardening = 3.0, step_s = 1e-3;
  JointScales scales;
  scales.inertia = 0.1;
  scales.torque_rms = 2.0;  // 20 rad/s2
  double const omega = 2.0 * std::numbers::pi * natural_hz, windup = 20.0 / (omega * omega);
  auto const drive = [](double t) { return 25.0 * std::sin(2.0 * std::numbers::pi * 5.0 * t); };
  auto const memory =
      find_effect("joint_elasticity")->runner(std::vector<double>{1.0, natural_hz, damping, hardening}, scales);
  constexpr int finer = 2000;
  double y = -drive(0.0) / (omega * omega), dy = 0.0, difference = 0.0, size = 0.0, stiffest = 0.0;
  for (int i = 0; i <= 2000; ++i) {
    for (int k = 0; i > 0 && k < finer; ++k) {
      double const h = step_s / finer, t = step_s * (i - 1) + h * (k + 0.5);
      double const stiffness = omega * omega * (1.0 + hardening * y * y / (windup * windup));
      dy += h * (-drive(t) - 2.0 * damping * omega * dy - stiffness * y);
      y += h * dy;
    }
    double const stiffening = hardening * y * y / (windup * windup);
    stiffest = std::max(stiffest, stiffening);
    double const t = step_s * i;
    double const expected = -2.0 * damping * omega * dy - omega * omega * y * (1.0 + stiffening) - drive(t);
    double const got = memory->torque({.time_s = t, .ddq = drive(t)}, i > 0 ? step_s : 0.0);
    difference += std::pow(got - expected, 2);
    size += expected * expected;
  }
  EXPECT_GT(stiffest, 1.0);  // more than twice as stiff as at rest
  EXPECT_LT(std::sqrt(difference / size), 0.01);
}

TEST(JointElasticity, VanishesForAStiffJoint) {
  auto motion = test::motion_of(test::smooth_state, 4000, 1000.0);
  auto const phi = test::columns_of(*find_effect("joint_elasticity"), {motion}, {300.0, 0.1, 0.0});
  EXPECT_LT(phi.norm(), 1e-3 * motion.ddq.norm());  // (2 Hz / 300 Hz)^2
}

}  // namespace memory_effects_test
}  // namespace torquescope
