// Servos in vector registers are the servos that are asked tick by tick: friction of the gear, and reads of an encoder.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/simulate/rollout/rollout_residuals.hpp"
#include "unit/rollout/servos.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace servo_paths_test {

// rollout.hpp: last digits differ. A tick of one step is the same sum in both but for the sine, which is carried on:
// rounding, in a loop that forgets. Of more steps a tick the registers follow the weight from the tick's beginning, the
// other from each step's: a turn x leaves x^2 / 2 of the weight's slope in the jerk, 1e-9 rad/s a tick here, which a
// drive that is off sums for a quarter of a second
constexpr double last_digits = 1e-12, by_series = 5e-8, velocity_for_position = 200.0;  // 1/s
constexpr double encoder_step = 2.0 * std::numbers::pi / 4096.0;
constexpr int samples = 300;
constexpr double rate_hz = 100.0;
constexpr PlainStart start{0.1, 0.4, 0.0};

PlainServo loaded() {
  PlainServo servo;
  servo.weight = 1.2;
  servo.load = 0.15;
  servo.load_square = 0.03;
  servo.stribeck = 0.08;
  servo.load_stribeck = 0.1;
  servo.limit = 9.0;
  servo.command_delay_s = 0.0233;
  servo.offset = 0.04;
  return servo;
}

RolloutTrack track(int ticks_per_sample = 10) {
  PlainInputs in;
  in.rate_hz = rate_hz;
  in.ticks_per_sample = ticks_per_sample;
  in.reference = servo_goals(samples, rate_hz);
  for (int k = 0; k < samples; ++k) {
    in.enabled.push_back(k % 120 < 95 ? 1.0 : 0.0);
    in.outside.push_back(0.1 * std::sin(0.05 * k));
  }
  return track_of(in, start);
}

// a wave of no size: tick by tick, as every effect
RolloutStructure asked_by_ticks() {
  RolloutStructure structure;
  structure.effects = {find_effect("cogging")};
  return structure;
}

RolloutTrial with_no_wave(RolloutTrial trial) {
  trial.effects = {{0.0, 0.0, 7.0}};
  return trial;
}

double largest(Eigen::MatrixXd const& a, Eigen::MatrixXd const& b) { return (a - b).cwiseAbs().maxCoeff(); }

std::vector<RolloutTrial> gears() {
  std::vector<PlainServo> servos(6, loaded());
  for (auto& servo : servos) servo.load = servo.load_square = servo.stribeck = servo.load_stribeck = 0.0;
  servos[0].load = 0.2;
  servos[1].load_square = 0.1;
  servos[2].stribeck = 0.15;
  servos[3].load_stribeck = 0.2;
  servos[4] = loaded();
  std::vector<RolloutTrial> trials;
  for (auto const& servo : servos) trials.push_back(trial_of(servo));
  return trials;
}

TEST(ServoPaths, RubGearsAlikeInRegistersAndTickByTick) {
  for (int const ticks : {5, 10}) {
    double const same = ticks == 10 ? last_digits : by_series;
    auto const fast = gears();
    std::vector<RolloutTrial> slow;
    for (auto const& trial : fast) slow.push_back(with_no_wave(trial));
    Rolled const a = rolled(track(ticks), {}, fast), b = rolled(track(ticks), asked_by_ticks(), slow);
    EXPECT_FALSE(same_bits(a.position, b.position)) << "both took one path";
    EXPECT_LT(largest(a.position, b.position), same);
    EXPECT_LT(largest(a.velocity, b.velocity), velocity_for_position * same);
    EXPECT_LT(largest(a.torque, b.torque), 60.0 * same);
    // each controller of a gear beside the last, which has none
    for (Eigen::Index lane = 0; lane < 5; ++lane)
      EXPECT_GT(largest(a.position.col(lane), a.position.col(5)), 1e-3) << lane;
  }
}

TEST(ServoPaths, OfAnEncoderShowItsStepsAndNothingBetween) {
  RolloutTrial trial = trial_of(loaded());
  trial.encoder_step = encoder_step;
  std::vector<RolloutTrial> trials(5, trial);
  for (std::size_t lane = 0; lane < trials.size(); ++lane)
    trials[lane].encoder_phase = encoder_step * (0.23 * static_cast<double>(lane) - 0.4);
  trials.push_back(trial_of(loaded()));  // exactly
  Rolled const all = rolled(track(), {}, trials);
  for (std::size_t lane = 0; lane < 5; ++lane)
    for (Eigen::Index k = 0; k < samples; ++k) {
      double const shown = all.position(k, static_cast<Eigen::Index>(lane)) + trials[lane].encoder_phase;
      ASSERT_NEAR(shown / encoder_step, std::round(shown / encoder_step), 1e-9) << lane;
    }
  EXPECT_TRUE(same_bits(all.position.col(5), rolled(track(), {}, {trial_of(loaded())}).position));
}

TEST(ServoPaths, AnswerWhatTheEncoderShows) {
  PlainServo servo = loaded();
  servo.limit = std::numeric_limits<double>::infinity();
  servo.command_delay_s = 0.0;
  servo.encoder_step = 8.0 * encoder_step;
  RolloutTrack const on = track();
  Rolled const all = rolled(on, {}, {trial_of(servo)});
  for (Eigen::Index k = 0; k < samples; ++k)
    ASSERT_NEAR(all.torque(k, 0), on.enabled[k] * servo.gain * (on.reference[k] - all.position(k, 0)), 1e-11);
}

TEST(ServoPaths, ReadAnEncoderAlikeInRegistersAndTickByTick) {
  std::vector<RolloutTrial> fast = gears(), slow;
  for (std::size_t lane = 0; lane < fast.size(); ++lane) {
    fast[lane].encoder_step = encoder_step;
    fast[lane].encoder_phase = encoder_step * (0.15 * static_cast<double>(lane) - 0.3);
    slow.push_back(with_no_wave(fast[lane]));
  }
  Rolled const a = rolled(track(), {}, fast), b = rolled(track(), asked_by_ticks(), slow);
  EXPECT_FALSE(same_bits(a.velocity, b.velocity)) << "both took one path";
  // no position lies within the last digits of a step's edge here, so that what is read is one number
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.torque, b.torque);
  EXPECT_LT(largest(a.velocity, b.velocity), velocity_for_position * last_digits);
}

// an identified controller that says kp (goal - q) once a sample is asked tick by tick too
TEST(ServoPaths, RubGearsAlikeUnderAnIdentifiedController) {
  PlainServo servo = loaded();
  servo.command_delay_s = 0.0;
  servo.limit = std::numeric_limits<double>::infinity();
  servo.encoder_step = encoder_step;
  RolloutTrack led = track(1), found = led;
  led.rate_hz = found.rate_hz = 1000.0;
  LoopController controller;
  controller.position = {-servo.gain};
  controller.reference = {0.0, servo.gain, 0.0};
  found.controller = controller;
  RolloutTrial const numbers = trial_of(servo);
  RolloutTrial identified = numbers;
  LoopNumbers const none;
  identified.loop.kp = none.kp;
  Rolled const a = rolled(led, {}, {numbers}), b = rolled(found, {}, {identified});
  EXPECT_LT(largest(a.position, b.position), last_digits);
  EXPECT_LT(largest(a.torque, b.torque), 60.0 * last_digits);
}

}  // namespace servo_paths_test
