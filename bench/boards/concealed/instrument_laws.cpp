// Faults of the instruments: what the channels show, and what a model of the joint misses because of them.
#include <gtest/gtest.h>

#include <cmath>

#include "concealed/baseline_fit.hpp"
#include "concealed/case_list.hpp"
#include "concealed/effect_size.hpp"
#include "concealed/seen_signals.hpp"

namespace concealed {
namespace instrument_laws_test {

TEST(ConcealedInstruments, LateTorqueShowsWhatWas) {
  Instruments const channel = {late_torque(2.5e-3, tick_s)};
  SeenSignals signals(channel);
  for (int k = 0; k < 20; ++k) {
    double const seen = signals.torque(k * tick_s, 3.0 * k);
    if (k < 3) continue;
    EXPECT_NEAR(seen, 3.0 * (k - 2.5), 1e-12);
  }
}

TEST(ConcealedInstruments, LimitsZeroFilterAndHoldAreWhatTheySay) {
  auto const limited = limited_torque(-2.0, 1.5);
  EXPECT_EQ(limited->torque(0.0, 9.0, nullptr), 1.5);
  EXPECT_EQ(limited->torque(0.0, -9.0, nullptr), -2.0);
  EXPECT_EQ(limited->torque(0.0, 0.7, nullptr), 0.7);

  auto const zero = creeping_zero(0.4, 10.0, -0.1, 20.0);
  EXPECT_EQ(zero->torque(0.0, 1.0, nullptr), 1.0);
  EXPECT_NEAR(zero->torque(10.0, 1.0, nullptr), 1.0 + 0.4 * (1.0 - std::exp(-1.0)), 1e-15);
  EXPECT_NEAR(zero->torque(1e3, 1.0, nullptr), 1.3, 1e-15);

  auto const filtered = filtered_torque(20.0, tick_s);
  double memory[2] = {0.0, 0.0}, seen = 0.0;
  double const time_constant_s = 1.0 / (2.0 * std::numbers::pi * 20.0);
  for (int k = 0; k < 8; ++k) seen = filtered->torque(0.0, 1.0, memory);
  EXPECT_NEAR(seen, 1.0 - std::exp(-8.0 * tick_s / time_constant_s), 1e-12);

  auto const held = held_torque(3);
  memory[0] = memory[1] = 0.0;
  for (int k = 0; k < 12; ++k) EXPECT_EQ(held->torque(0.0, k, memory), k - k % 3);
}

TEST(ConcealedInstruments, DiscErrorHasTheDerivativesItClaims) {
  auto const disc = eccentric_disc(0.003, 0.5);
  double const h = 1e-4;
  for (double q : {-2.0, 0.1, 1.7}) {
    auto const low = disc->position(q - h), here = disc->position(q), high = disc->position(q + h);
    EXPECT_NEAR((high.error - low.error) / (2.0 * h), here.slope, 1e-10);
    EXPECT_NEAR((high.slope - low.slope) / (2.0 * h), here.bend, 1e-10);
  }
}

Case brief_case() {
  Case brief = clean_case(2);
  brief.rig = without_noise({joint_named("elbow"), controller_named("pd"), noise_named("none"), 0});
  brief.train = Recipe::mixed;
  brief.train_s = 12.0;
  return brief;
}

TEST(ConcealedInstruments, TorqueFaultsLeaveTheMotionAlone) {
  Case const brief = brief_case();
  LoopRun const right = training_run(brief, brief.rig, {}, default_step_s);
  ConcealedEffect const fault = late_torque_of(0.003)(brief.rig.joint);
  LoopRun const late = training_run(brief, brief.rig, {fault}, default_step_s);
  EXPECT_EQ(late.recording.position, right.recording.position);
  ASSERT_EQ(late.truth.added.size(), 1u);
  for (std::size_t k = 5; k < late.truth.t.size(); ++k) {
    ASSERT_EQ(late.recording.torque[k], right.recording.torque[k - 3]);
    ASSERT_NEAR(late.truth.added[0][k], right.truth.motor[k - 3] - right.truth.motor[k], 1e-12);
  }
}

TEST(ConcealedInstruments, WhatTheModelMissesIsWhatTheFaultFakes) {
  // a model with the true parameters, held against the seen motion and torque
  Case const brief = brief_case();
  for (auto const& maker : {eccentric_disc_of(0.005, 0.7), creeping_zero_of(0.2, 9.0, 0.3, 6.0)}) {
    LoopRun const run = training_run(brief, brief.rig, {maker(brief.rig.joint)}, default_step_s);
    auto const residual = baseline_residual(run.truth, brief.rig.joint.baseline);
    EXPECT_GT(rms(residual), 1e-4);
    for (std::size_t k = 0; k < residual.size(); ++k) {
      if (!run.truth.moves[k]) continue;
      ASSERT_NEAR(residual[k], run.truth.added[0][k], 1e-9);
    }
  }
}

TEST(ConcealedInstruments, DigitsWithoutMeaningBlurTheReading) {
  Case brief = brief_case();
  brief.rig.encoder_bits = 16;
  brief.rig.noisy_bits = 3;
  LoopRun const run = training_run(brief, brief.rig, {}, default_step_s);
  double const step = 2.0 * std::numbers::pi / std::exp2(16);
  double worst = 0.0;
  for (std::size_t k = 0; k < 200; ++k) worst = std::max(worst, std::abs(run.recording.position[k]));
  EXPECT_GT(worst, 2.0 * step);
  EXPECT_LT(worst, 10.0 * step);
}

TEST(ConcealedLoop, FeedforwardOfTheTrueModelFollowsCloser) {
  Case brief = brief_case();
  auto worst = [&] {
    LoopRun const run = training_run(brief, brief.rig, {}, default_step_s);
    double largest = 0.0;
    for (std::size_t k = 0; k < run.recording.time.size(); ++k) {
      largest = std::max(largest, std::abs(run.recording.reference[k] - run.recording.position[k]));
    }
    return largest;
  };
  double const without = worst();
  Baseline const& base = brief.rig.joint.baseline;
  brief.rig.controller.feedforward = {base.inertia, base.viscous, base.coulomb, 0.01 * brief.rig.joint.limits.speed};
  EXPECT_LT(worst(), 0.5 * without);
}

}  // namespace instrument_laws_test
}  // namespace concealed
