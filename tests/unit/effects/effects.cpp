// Rules that every listed effect obeys.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "unit/effects/smooth_motion.hpp"

namespace torquescope {
namespace effects_test {

using test::columns_of;
using test::KnownJoint;
using test::linear_part;
using test::parameters_with;
using test::shape_between;

constexpr Eigen::Index n_samples = 4000;
constexpr double rate_hz = 500.0;

// everything an effect may ask for, on one motion
struct Bench {
  KnownJoint joint{};
  Motion motion = test::motion_of(test::smooth_state, n_samples, rate_hz);
  FittedBaseline baseline = joint.baseline(motion);
  EffectInput input() const { return baseline.input(motion); }
};

class EveryEffect : public testing::TestWithParam<Effect const*> {};

TEST_P(EveryEffect, IsFoundByItsNameAndExplainsItself) {
  auto const& effect = *GetParam();
  EXPECT_EQ(find_effect(effect.name()), &effect);
  EXPECT_FALSE(effect.title().empty());
  EXPECT_FALSE(effect.equation().empty());
  EXPECT_FALSE(effect.source().empty());
  EXPECT_FALSE(effect.signature().empty());
  for (auto const& parameter : effect.parameters()) EXPECT_FALSE(parameter.unit_revolute.empty());
}

TEST_P(EveryEffect, HasFiniteColumnsEverywhereInItsBoundsAndNoneIsZero) {
  auto const& effect = *GetParam();
  Bench const bench;
  for (double const share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    auto const phi = columns_of(effect, bench.input(), shape_between(effect, bench.baseline.scales, share));
    EXPECT_TRUE(phi.allFinite()) << share;
    for (Eigen::Index k = 0; k < phi.cols() && share == 0.5; ++k) EXPECT_GT(phi.col(k).norm(), 0.0) << k;
  }
}

TEST_P(EveryEffect, HasNoParameterWithoutAUnitOnASlide) {
  auto const& effect = *GetParam();
  if (!effect.exists_on(JointKind::prismatic)) return;
  KnownJoint const slide{JointKind::prismatic};
  auto motion = test::motion_of(test::smooth_state, n_samples, rate_hz);
  auto const baseline = slide.baseline(motion);
  auto const phi = columns_of(effect, baseline.input(motion), shape_between(effect, baseline.scales));
  EXPECT_TRUE(phi.allFinite());
  for (std::size_t k = 0; k < effect.n_linear(); ++k)
    EXPECT_EQ(phi.col(static_cast<Eigen::Index>(k)).norm() > 0.0, !effect.parameters()[k].unit_prismatic.empty()) << k;
}

// on the recorded samples columns and runner are the same sum, only added up in another order
TEST_P(EveryEffect, RunsOverTheRecordingAsItsColumnsSay) {
  auto const& effect = *GetParam();
  if (effect.acts_on() == ActsOn::recorded_position) return;  // the runner gives positions
  // the runner wants the command or the recorded torque: see channel_effects.cpp
  if (effect.name() == "actuator_lag" || effect.name() == "torque_constant") return;
  Bench const bench;
  auto const parameters = parameters_with(effect, shape_between(effect, bench.baseline.scales));
  Eigen::VectorXd const expected =
      columns_of(effect, bench.input(), shape_between(effect, bench.baseline.scales)) * linear_part(effect, parameters);
  double const rounding = 1e-12 * (1.0 + expected.cwiseAbs().maxCoeff());
  auto const runner = effect.runner(parameters, bench.baseline.scales);
  for (Eigen::Index i = 0; i < n_samples; ++i)
    ASSERT_NEAR(runner->torque(bench.input().state(i), i > 0 ? 1.0 / rate_hz : 0.0), expected[i], rounding) << i;
}

// How often something happens at an instant: velocity or load turn round; in backlash each has a beginning and an end.
int count_events(EffectInput const& input) {
  int events = 2;  // the ends of the recording
  for (Eigen::Index i = 1; i < input.size(); ++i) {
    auto const before = input.state(i - 1), now = input.state(i);
    events += before.dq * now.dq <= 0.0 ? 2 : 0;
    events += before.load_torque * now.load_torque <= 0.0 ? 2 : 0;
  }
  return events;
}

// Simulation takes finer steps than the recording: what it does in between must amount to the same. Compared by the
// integral of the torque, because an impact lasts one step, whatever its length.
TEST_P(EveryEffect, RunsAlikeInFinerSteps) {
  auto const& effect = *GetParam();
  if (effect.acts_on() == ActsOn::recorded_position || effect.name() == "actuator_lag" ||
      effect.name() == "torque_constant")
    return;
  constexpr int finer = 16;
  Bench const coarse;
  Bench fine;
  fine.motion = test::motion_of(test::smooth_state, finer * n_samples, finer * rate_hz);
  fine.baseline = fine.joint.baseline(fine.motion);
  auto const shape = shape_between(effect, coarse.baseline.scales);
  auto const parameters = parameters_with(effect, shape);
  Eigen::VectorXd const expected = columns_of(effect, coarse.input(), shape) * linear_part(effect, parameters);

  auto const runner = effect.runner(parameters, coarse.baseline.scales);
  double difference = 0.0, largest = 0.0;
  for (Eigen::Index i = 0; i < finer * n_samples; ++i) {
    difference += runner->torque(fine.input().state(i), i > 0 ? 1.0 / (finer * rate_hz) : 0.0) / (finer * rate_hz);
    if (i % finer == 0) difference -= expected[i / finer] / rate_hz;
    largest = std::max(largest, std::abs(difference));
  }
  // an event is seen up to one sample late, and nothing is wrong by more than the effect's largest torque meanwhile
  double const late_events = count_events(coarse.input()) * expected.cwiseAbs().maxCoeff() / rate_hz;
  EXPECT_LT(largest, late_events);
}

TEST_P(EveryEffect, DoesNotCareWhenTheClockStarted) {
  auto const& effect = *GetParam();
  Bench const bench;
  Bench later;
  later.motion = test::motion_of(test::smooth_state, n_samples, rate_hz, 64.0);
  later.baseline = later.joint.baseline(later.motion);
  auto const phi = columns_of(effect, bench.input(), shape_between(effect, bench.baseline.scales));
  auto const shifted = columns_of(effect, later.input(), shape_between(effect, later.baseline.scales));
  // time stamps near 64 s carry 1e-14 s, divided by a step in derivatives and by a span in ratios
  EXPECT_LT((phi - shifted).norm(), 1e-9 * phi.norm());
}

TEST_P(EveryEffect, HasTheParityItClaims) {
  auto const& effect = *GetParam();
  KnownJoint joint;
  joint.parameters = {0.05, 0.2, 0.3, -0.3, 1.2, -0.4};  // unequal levels are no effect's parity

  if (effect.has_memory()) {  // dq -> -dq means another past: mirror the whole motion instead
    if (effect.parity() != Parity::odd) return;
    auto motion = test::motion_of(test::smooth_state, n_samples, rate_hz);
    auto mirrored = motion;
    for (auto* channel : {&mirrored.q, &mirrored.dq, &mirrored.ddq}) *channel *= -1.0;
    auto const baseline = joint.baseline(motion);
    auto const shape = shape_between(effect, baseline.scales);
    auto const phi = columns_of(effect, baseline.input(motion), shape);
    auto const mirror = columns_of(effect, baseline.input(mirrored), shape);
    EXPECT_LT((phi + mirror).norm(), 1e-12 * phi.norm());
    return;
  }

  auto motion = test::motion_of(test::smooth_state, n_samples, rate_hz);
  auto back = motion;
  back.dq *= -1.0;
  auto const forth_baseline = joint.baseline(motion), back_baseline = joint.baseline(back);
  auto const shape = shape_between(effect, forth_baseline.scales, 0.3);  // half way a ratio may be 1, and symmetric
  auto const phi = columns_of(effect, forth_baseline.input(motion), shape);
  auto const flipped = columns_of(effect, back_baseline.input(back), shape);
  double const rounding = 1e-12 * phi.norm();
  bool const is_odd = (phi + flipped).norm() < rounding, is_even = (phi - flipped).norm() < rounding;
  EXPECT_EQ(is_odd, effect.parity() == Parity::odd);
  EXPECT_EQ(is_even, effect.parity() == Parity::even);
}

TEST_P(EveryEffect, IsDryFrictionExactlyWhenItsTorqueJumpsAtRest) {
  auto const& effect = *GetParam();
  Bench const bench;
  auto const runner =
      effect.runner(parameters_with(effect, shape_between(effect, bench.baseline.scales)), bench.baseline.scales);
  bool has_jumped = false;
  for (Eigen::Index i = 0; i < n_samples; ++i) {
    auto state = bench.input().state(i);
    runner->advance(state, i > 0 ? 1.0 / rate_hz : 0.0);
    state.dq = 1e-300;
    double const forwards = runner->torque(state);
    state.dq = -1e-300;
    has_jumped = has_jumped || std::abs(forwards - runner->torque(state)) > 1e-6;
  }
  EXPECT_EQ(effect.is_dry_friction() || effect.is_partly_dry(), has_jumped);
}

// the effect that lets a plant find the joint's inertia: two trial accelerations tell all others
TEST_P(EveryEffect, IsAffineInTheAccelerationOfATrial) {
  auto const& effect = *GetParam();
  if (effect.is_dry_friction() && effect.needs_baseline())
    return;  // follows the load: asked at the load's acceleration
  Bench const bench;
  auto const runner =
      effect.runner(parameters_with(effect, shape_between(effect, bench.baseline.scales)), bench.baseline.scales);
  for (Eigen::Index i = 0; i < n_samples; i += 7) {
    auto state = bench.input().state(i);
    runner->advance(state, i > 0 ? 7.0 / rate_hz : 0.0);
    auto const at = [&](double ddq) {
      state.ddq = ddq;
      return runner->torque(state);
    };
    double const base = at(0.0), slope = at(1.0) - base;
    ASSERT_NEAR(at(-3.0), base - 3.0 * slope, 1e-11 * (1.0 + std::abs(base) + std::abs(slope)));
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryEffect, testing::ValuesIn(effect_choices()),
                         [](auto const& choice) { return choice.param->name(); });

TEST(EffectNames, AreDifferentAndSoAreParameterNames) {
  std::set<std::string> effects, parameters;
  for (auto const* effect : effect_choices()) {
    EXPECT_TRUE(effects.insert(effect->name()).second) << effect->name();
    for (auto const& parameter : effect->parameters())
      EXPECT_TRUE(parameters.insert(parameter.name).second) << parameter.name;
  }
  EXPECT_EQ(find_effect("no_such_effect"), nullptr);
}

TEST(EffectNames, AreThoseOfTheCatalogue) {
  for (auto const* name : {"asymmetric_viscous",
                           "stribeck",
                           "speed_drag",
                           "power_law_viscous",
                           "presliding",
                           "maxwell_slip",
                           "breakaway_dwell",
                           "friction_lag",
                           "position_dependent_friction",
                           "load_dependent_friction",
                           "directional_efficiency",
                           "thermal_friction",
                           "friction_drift",
                           "gravity",
                           "spring",
                           "cable",
                           "end_stop",
                           "cogging",
                           "torque_ripple",
                           "transmission_error",
                           "joint_elasticity",
                           "backlash",
                           "delay",
                           "actuator_lag",
                           "torque_constant",
                           "clipping",
                           "sensor_drift",
                           "encoder_eccentricity",
                           "contact",
                           "payload_change",
                           "periodic_disturbance"}) {
    auto const* effect = find_effect(name);
    ASSERT_NE(effect, nullptr) << name;
    EXPECT_NE(effect->family(), EffectFamily::baseline) << name;
  }
}

}  // namespace effects_test
}  // namespace torquescope
