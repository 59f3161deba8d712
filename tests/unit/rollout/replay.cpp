// A replay's numbers are those of a pocket calculator on all samples that are in, and of none that was left out.

#include "engine/simulate/rollout/replay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/rollout/recorded_joints.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace replay_test {

constexpr int samples = 1500;

struct Case {
  RolloutTrack track;
  Recording recording{};
  Eigen::VectorXd velocity{};
};

Case recorded_case(PlainJoint const& joint, PlainController const& controller, std::vector<Stretch> const& left_out,
                   Sensors const& sensors = {}) {
  Case made{recorded(joint, controller, moved(samples), sensors)};
  made.recording.name = "plain.csv";
  made.recording.rate_hz = made.track.rate_hz;
  made.recording.time_s = made.track.time_s;
  made.recording.position = made.track.position;
  made.recording.torque = made.track.torque;
  made.recording.reference = made.track.reference;
  made.recording.rows.encoder_step = sensors.encoder_step;
  made.recording.left_out = left_out;
  made.track = torquescope::track_of(made.recording, {});
  made.velocity = Eigen::VectorXd::Zero(samples);
  for (Eigen::Index k = 1; k + 1 < samples; ++k)
    made.velocity[k] = 0.5 * (made.track.position[k + 1] - made.track.position[k - 1]) * made.track.rate_hz;
  return made;
}

ReplayedModel model_of(PlainJoint const& joint, PlainController const& controller) {
  return {structure_of(controller), trial_of(joint, controller)};
}

void expect_by_hand(ChannelReplay const& channel, std::size_t model, std::vector<bool> const& is_in, bool about_mean) {
  double n = 0.0, squares = 0.0, sizes = 0.0, sum = 0.0, signal = 0.0;
  for (std::size_t k = 0; k < is_in.size(); ++k) {
    if (!is_in[k]) continue;
    auto const at = static_cast<Eigen::Index>(k);
    double const off = channel.measured[at] - channel.simulated[model][at];
    n += 1.0;
    squares += off * off;
    sizes += std::abs(off);
    sum += channel.measured[at];
  }
  double const mean = about_mean ? sum / n : 0.0;
  for (std::size_t k = 0; k < is_in.size(); ++k)
    if (is_in[k]) signal += std::pow(channel.measured[static_cast<Eigen::Index>(k)] - mean, 2.0);
  EXPECT_EQ(channel.errors[model].samples, static_cast<std::int64_t>(n));
  EXPECT_NEAR(channel.errors[model].rms, std::sqrt(squares / n), 1e-12);
  EXPECT_NEAR(channel.errors[model].mae, sizes / n, 1e-12);
  EXPECT_NEAR(channel.signal_rms, std::sqrt(signal / n), 1e-12);
  EXPECT_NEAR(channel.errors[model].relerr, std::sqrt(squares / signal), 1e-12);
}

TEST(Replay, HasTheErrorsOfAllSamples) {
  PlainJoint const joint = dry_joint();
  PlainController const controller = controller_of("pd");
  Case const one = recorded_case(joint, controller, {{0.9, 1.4}});
  PlainJoint wrong = joint;
  wrong.inertia *= 1.5;
  wrong.forward = 0.2;
  RecordingReplay const replay = replay_recording(one.recording, one.track, one.velocity,
                                                  {model_of(wrong, controller), model_of(joint, controller)});
  std::vector<bool> is_in(samples, true);
  for (std::size_t k = 0; k < samples; ++k) {
    double const time_s = static_cast<double>(k) / 500.0;
    is_in[k] = !(time_s > 0.9 && time_s < 1.4);
  }
  for (std::size_t model = 0; model < 2; ++model) {
    expect_by_hand(replay.channel(ReplayChannel::position), model, is_in, true);
    expect_by_hand(replay.channel(ReplayChannel::velocity), model, is_in, true);
    expect_by_hand(replay.channel(ReplayChannel::torque), model, is_in, false);
    EXPECT_FALSE(replay.diverged[model]);
  }
  auto const& position = replay.channel(ReplayChannel::position);
  EXPECT_LT(position.errors[1].rms, position.errors[0].rms);
  for (std::size_t k = 0; k < samples; ++k)
    EXPECT_EQ(std::isnan(position.simulated[1][static_cast<Eigen::Index>(k)]), !is_in[k]) << k;
  // the simulation is that of a rollout
  Rolled const alone = rolled(one.track, structure_of(controller), {trial_of(joint, controller)});
  EXPECT_EQ(alone.position(300, 0), position.simulated[1][300]);
  EXPECT_EQ(alone.torque(1200, 0), replay.channel(ReplayChannel::torque).simulated[1][1200]);
}

// whatever stands where a recording was filled
TEST(Replay, TakesNothingFromWhatWasLeftOut) {
  PlainJoint const joint = dry_joint();
  PlainController const controller = controller_of("pd");
  Case one = recorded_case(joint, controller, {{0.9, 1.4}});
  auto const replay = [&] {
    return replay_recording(one.recording, one.track, one.velocity, {model_of(joint, controller)});
  };
  RecordingReplay const before = replay();
  for (auto* channel : {&one.track.position, &one.track.torque, &one.velocity})
    channel->segment(455, 200).array() += 7.0;
  RecordingReplay const after = replay();
  for (std::size_t c = 0; c < replay_channels; ++c) {
    EXPECT_EQ(before.channels[c].errors[0].rms, after.channels[c].errors[0].rms);
    EXPECT_EQ(before.channels[c].errors[0].mae, after.channels[c].errors[0].mae);
    EXPECT_EQ(before.channels[c].signal_rms, after.channels[c].signal_rms);
  }
}

TEST(Replay, TellsAModelThatDiverges) {
  PlainJoint const joint = dry_joint();
  PlainController const controller = controller_of("pd");
  Case const one = recorded_case(joint, controller, {});
  ReplayedModel wild = model_of(joint, controller);
  wild.trial.loop.kd = 300.0;
  RecordingReplay const replay =
      replay_recording(one.recording, one.track, one.velocity, {model_of(joint, controller), wild});
  EXPECT_FALSE(replay.diverged[0]);
  EXPECT_TRUE(replay.diverged[1]);
  auto const& errors = replay.channel(ReplayChannel::position).errors;
  EXPECT_TRUE(std::isfinite(errors[0].rms));
  EXPECT_TRUE(std::isnan(errors[1].rms));
  EXPECT_TRUE(std::isnan(replay.horizon_s));
}

TEST(Replay, HasTheUsersOwnSimulatorLast) {
  PlainJoint const joint = dry_joint();
  PlainController const controller = controller_of("pd");
  Case one = recorded_case(joint, controller, {});
  one.recording.simulated_position = one.track.position.array() + 0.01;
  RecordingReplay const replay =
      replay_recording(one.recording, one.track, one.velocity, {model_of(joint, controller)});
  ASSERT_EQ(replay.diverged.size(), 2u);
  EXPECT_NEAR(replay.channel(ReplayChannel::position).errors[1].rms, 0.01, 1e-12);
  EXPECT_TRUE(std::isnan(replay.channel(ReplayChannel::torque).errors[1].rms)) << "it says nothing of the torque";
  EXPECT_FALSE(replay.diverged[1]);
}

TEST(Replay, WithoutAReferenceSaysNothingOfTheTorque) {
  PlainJoint const joint = dry_joint();
  Case one = recorded_case(joint, controller_of("pd"), {});
  one.recording.reference.resize(0);
  one.track = torquescope::track_of(one.recording, {});
  ReplayedModel open{structure_of({}), trial_of(joint, {})};
  open.trial.loop = numbers_of(LoopForm::none, {});
  RecordingReplay const replay = replay_recording(one.recording, one.track, one.velocity, {open});
  EXPECT_EQ(replay.channel(ReplayChannel::torque).measured.size(), 0);
  EXPECT_EQ(replay.channel(ReplayChannel::position).errors[0].samples, samples);
  EXPECT_TRUE(std::isnan(replay.horizon_s));
}

TEST(Replay, OfAStableJointHasNoHorizon) {
  PlainJoint const joint = dry_joint();
  PlainController const controller = controller_of("pd");
  Case const one = recorded_case(joint, controller, {});
  EXPECT_TRUE(
      std::isnan(replay_recording(one.recording, one.track, one.velocity, {model_of(joint, controller)}).horizon_s));
}

// an arm held upside down by a weak loop: a step of its encoder decides to which side it falls
TEST(Replay, OfAJointThatAStepOfItsEncoderDecidesEndsSomewhere) {
  PlainJoint joint;
  joint.viscous = 0.3;
  joint.gravity_sin = -2.0;
  PlainController const weak{"pd", 1.0, 0.0, 0.1};
  PlainInputs inputs;
  for (int k = 0; k < samples; ++k) inputs.reference.push_back(0.3 * std::sin(0.02 * k) * std::min(1.0, 0.002 * k));
  Case one = recorded_case(joint, weak, {});
  RolloutTrack const fallen = recorded(joint, weak, inputs, {.encoder_step = 2e-3});
  one.track = fallen;
  one.recording.reference = fallen.reference;
  PlainJoint guessed = joint;
  guessed.gravity_sin *= 0.98;
  double const horizon = replay_recording(one.recording, one.track, one.velocity, {model_of(guessed, weak)}).horizon_s;
  EXPECT_GE(horizon, 0.0);
  EXPECT_LT(horizon, samples / 500.0);
}

}  // namespace replay_test
