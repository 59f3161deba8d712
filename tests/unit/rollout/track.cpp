// A recording as rollouts follow it: runs between gaps, windows without a reference, ticks of a faster controller.

#include "engine/simulate/rollout/track.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/simulate/rollout/rollout_residuals.hpp"
#include "unit/rollout/loops.hpp"

using namespace torquescope;
using namespace torquescope::test;
using testing::HasSubstr;

namespace track_test {

constexpr int samples = 2000;
constexpr double rate_hz = 500.0;

PlainJoint joint() {
  PlainJoint made;
  made.gravity_sin = 0.5;
  made.forward = 0.2;
  made.backward = -0.2;
  return made;
}

PlainController const controller{"pd", 20.0, 0.0, 1.1};

PlainInputs inputs() {
  PlainInputs made;
  made.reference = waves(samples, rate_hz);
  return made;
}

// of a joint in its loop, exactly
Recording recorded() {
  PlainMotion const motion = PlainLoop(joint(), controller, inputs(), {}, 40).run();
  Recording recording;
  recording.name = "plain.csv";
  recording.rate_hz = rate_hz;
  recording.time_s = Eigen::VectorXd::LinSpaced(samples, 0.0, (samples - 1) / rate_hz);
  recording.position = vector_of(motion.position);
  recording.velocity = vector_of(motion.velocity);
  recording.torque = vector_of(motion.torque);
  recording.reference = vector_of(inputs().reference);
  return recording;
}

TEST(Track, StretchesAreSpreadOverItsTimeAndBeginAsMeasured) {
  Recording recording = recorded();
  recording.left_out = {{1.5, 1.7}};
  RolloutTrack const whole = track_of(recording, {});
  constexpr Eigen::Index most = 400;
  RolloutTrack const track = in_stretches(whole, most);
  EXPECT_LE(track.samples(), most);
  EXPECT_GT(track.samples(), most - 8);
  EXPECT_EQ(track.segments.front().first, 0);
  EXPECT_EQ(track.segments.back().first + track.segments.back().samples, samples);
  Eigen::Index end = 0;
  for (auto const& segment : track.segments) {
    EXPECT_GE(segment.first, end);
    end = segment.first + segment.samples;
    Eigen::Index const begin = segment.first - segment.settling;
    EXPECT_EQ(segment.settling, segment.first == 0 ? 0 : most / 4 / 4);
    EXPECT_EQ(segment.position, recording.position[begin]);
    EXPECT_NEAR(segment.velocity, recording.velocity[begin], 0.02);
    EXPECT_EQ(segment.torque, recording.torque[std::max<Eigen::Index>(begin - 1, 0)]);
    double const from_s = static_cast<double>(segment.first) / rate_hz,
                 until_s = static_cast<double>(end - 1) / rate_hz;
    EXPECT_TRUE(until_s <= 1.5 || from_s >= 1.7) << from_s;
  }
  EXPECT_EQ(in_stretches(whole, samples).samples(), whole.samples());
}

// the simulation of a stretch is that of a segment which begins where it settles, less what it settles for
TEST(Track, WhatSettlesIsSimulatedAndNotCompared) {
  RolloutTrack whole = track_of(recorded(), {}), settled = whole;
  whole.segments = {{300, 700, 0.1, 0.2, 0.3}};
  settled.segments = {{450, 550, 0.1, 0.2, 0.3, 150}};
  RolloutTrial const trial = trial_of(joint(), controller);
  Rolled const all = rolled(whole, structure_of(controller), {trial});
  Rolled const told = rolled(settled, structure_of(controller), {trial});
  EXPECT_TRUE(same_bits(told.position.middleRows(450, 550), all.position.middleRows(450, 550)));
  EXPECT_TRUE(same_bits(told.torque.middleRows(450, 550), all.torque.middleRows(450, 550)));
  EXPECT_TRUE(told.position.topRows(450).array().isNaN().all());
  EXPECT_TRUE(all.position.middleRows(300, 150).allFinite());
}

TEST(Track, BeginsAnewBehindEveryGap) {
  Recording recording = recorded();
  recording.left_out = {{0.5, 0.7}, {2.0, 2.5}, {3.0, 3.3}, {3.31, 3.6}};
  RolloutTrack const track = track_of(recording, {});
  // what lies between the last two is too short to be simulated
  ASSERT_EQ(track.segments.size(), 4u);
  Eigen::Index last = -1, sum = 0;
  for (auto const& segment : track.segments) {
    EXPECT_GT(segment.first, last);
    last = segment.first + segment.samples - 1;
    sum += segment.samples;
    EXPECT_EQ(segment.position, recording.position[segment.first]);
    // a line over the next twelve samples is as fast as the joint in their middle, of a motion of some 20 rad/s^2
    EXPECT_NEAR(segment.velocity, recording.velocity[segment.first], 20.0 * 5.5 / rate_hz);
    for (auto const& stretch : recording.left_out)
      for (Eigen::Index const k : {segment.first, last}) {
        double const time_s = static_cast<double>(k) / rate_hz;
        EXPECT_FALSE(time_s > stretch.from_s && time_s < stretch.until_s);
      }
  }
  EXPECT_EQ(track.samples(), sum);
  EXPECT_EQ(track.segments[1].first, 350);
  EXPECT_EQ(track.drive, TrackDrive::reference);
}

TEST(Track, OfGapsIsSimulatedAsItsRunsAlone) {
  Recording recording = recorded();
  recording.left_out = {{1.0, 1.8}};
  RolloutTrack const track = track_of(recording, {});
  ASSERT_EQ(track.segments.size(), 2u);
  RolloutTrial const trial = trial_of(joint(), controller);
  Rolled const whole = rolled(track, structure_of(controller), {trial});
  for (auto const& segment : track.segments) {
    RolloutTrack cut = track;
    cut.segments = {{0, segment.samples, segment.position, segment.velocity, segment.torque}};
    for (auto* channel : {&cut.time_s, &cut.reference, &cut.position, &cut.torque})
      *channel = channel->segment(segment.first, segment.samples).eval();
    Rolled const alone = rolled(cut, structure_of(controller), {trial});
    EXPECT_TRUE(same_bits(whole.position.middleRows(segment.first, segment.samples), alone.position));
    EXPECT_TRUE(same_bits(whole.torque.middleRows(segment.first, segment.samples), alone.torque));
    EXPECT_EQ(whole.position(segment.first, 0), recording.position[segment.first]);
    // the loop pulls what the start got wrong together
    Eigen::Index const end = segment.first + segment.samples - 1;
    EXPECT_NEAR(whole.position(end, 0), recording.position[end], 1e-4);
  }
  EXPECT_TRUE(whole.position.middleRows(501, 398).array().isNaN().all());
}

TEST(Track, WithoutAReferenceIsDrivenByItsTorqueInWindows) {
  Recording recording = recorded();
  recording.reference.resize(0);
  TrackOptions options;
  options.window_s = 0.05;
  RolloutTrack const track = track_of(recording, options);
  EXPECT_EQ(track.drive, TrackDrive::torque);
  ASSERT_EQ(track.segments.size(), static_cast<std::size_t>(samples / 25));
  EXPECT_EQ(track.samples(), samples);
  RolloutTrial trial = trial_of(joint(), {});
  trial.loop = numbers_of(LoopForm::none, {});
  Rolled const all = rolled(track, structure_of({}), {trial});
  double largest = 0.0;
  for (auto const& segment : track.segments) {
    EXPECT_EQ(all.position(segment.first, 0), recording.position[segment.first]);
    for (Eigen::Index k = segment.first; k < segment.first + segment.samples; ++k) {
      EXPECT_EQ(all.torque(k, 0), recording.torque[k]);
      largest = std::max(largest, std::abs(all.position(k, 0) - recording.position[k]));
    }
  }
  // a start wrong by half of what the speed changes by in ten milliseconds, for a window
  EXPECT_LT(largest, 0.005);
  // its torque is no second channel
  std::vector<RolloutTrack> const tracks{track};
  RolloutTask const task{tracks, {structure_of({})}};
  EXPECT_FALSE(task.count(0, 1));
  auto const sums = sums_of_squares(task, std::vector<RolloutTrial>{trial}, 1);
  EXPECT_GT(sums[0][0], 0.0);
  EXPECT_EQ(sums[0][1], 0.0);
  options.window_s = 0.0;
  EXPECT_EQ(track_of(recording, options).segments.size(), 1u);
}

TEST(Track, TicksAsItsControllerDoes) {
  Recording const recording = recorded();
  TrackOptions options;
  EXPECT_EQ(track_of(recording, options).ticks_per_sample, 1u);
  options.controller_rate_hz = 2000.0;
  options.straight_reference = true;
  RolloutTrack const track = track_of(recording, options);
  EXPECT_EQ(track.ticks_per_sample, 4u);
  EXPECT_DOUBLE_EQ(track.tick_s(), 0.0005);
  EXPECT_TRUE(track.straight_reference);
  options.controller_rate_hz = 250.0;
  EXPECT_EQ(track_of(recording, options).ticks_per_sample, 1u) << "the controller holds";
}

TEST(Track, OfARecordingThatIsAllGapsIsRefused) {
  Recording recording = recorded();
  recording.left_out = {{0.01, 3.99}};
  try {
    track_of(recording, {});
    FAIL();
  } catch (Error const& error) {
    ASSERT_EQ(error.problems().size(), 1u);
    EXPECT_EQ(error.problems()[0].code, ExitCode::bad_data);
    EXPECT_THAT(error.problems()[0].what, HasSubstr("plain.csv"));
    EXPECT_FALSE(error.problems()[0].help.empty());
  }
}

// an effect of the time goes by the recording's clock, whatever was left out before
TEST(Track, KeepsItsClockBehindGaps) {
  Recording recording = recorded();
  recording.left_out = {{1.0, 1.8}};
  RolloutTrack const track = track_of(recording, {});
  Effect const& effect = *find_effect("payload_change");
  RolloutStructure structure = structure_of(controller);
  structure.effects = {&effect};
  structure.scales.duration_s = 4.0;
  auto const& parameters = effect.parameters();
  std::vector<double> values(parameters.size(), 0.0);
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = parameters[k].is_instant() ? 3.0 : k < effect.n_linear() ? 0.3 : 0.0;
  RolloutTrial with = trial_of(joint(), controller), without = with;
  with.effects = {values};
  Rolled const changed = rolled(track, structure, {with}), plain = rolled(track, structure_of(controller), {without});
  Eigen::VectorXd const off = (changed.position - plain.position).cwiseAbs();
  auto const at = [](double time_s) { return static_cast<Eigen::Index>(time_s * rate_hz); };
  EXPECT_LT(off.segment(at(1.9), at(1.0)).maxCoeff(), 1e-6) << "before it begins, at 3 s";
  EXPECT_GT(off.tail(at(0.9)).maxCoeff(), 1e-3);
}

}  // namespace track_test
