#pragma once
// A recording beside its simulation by several models, channel by channel, on every sample.
//
// Channels   position, velocity (where it was measured or derived), torque; errors are measured - simulated, relative
//            to the rms of the torque, of the velocity about its mean, or of untold_positions() (track.hpp)
// Left out   samples of the recording's gaps: NaN in a simulation, and in no number; `samples` counts the others
// Horizon    sixteen replicates, whose encoders lie elsewhere within a step and which begin within one: the first half
//            second in which they differ among themselves by as much as the simulation from the recording, and by two
//            steps of the encoder, by the recording's clock; NaN: in none
// Units      SI of the joint's kind
// Threads    free function; same bits on any number of threads

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/data/recording.hpp"
#include "engine/simulate/rollout/rollout.hpp"

namespace torquescope {

enum class ReplayChannel { position, velocity, torque };
inline constexpr std::size_t replay_channels = 3;
std::string word(ReplayChannel channel);

struct ChannelError {
  std::int64_t samples = 0;
  double rms = 0.0, mae = 0.0, relerr = 0.0;  // NaN: the model says nothing of the channel, or has diverged
};

struct ChannelReplay {
  double signal_rms = 0.0;
  Eigen::VectorXd measured{};                // [n]; empty: not there
  std::vector<Eigen::VectorXd> simulated{};  // of each model
  std::vector<ChannelError> errors{};
};

struct RecordingReplay {
  std::string name;
  bool is_validation = false;
  TrackDrive drive = TrackDrive::reference;
  double rate_hz = 0.0, window_s = 0.0;
  Eigen::VectorXd time_s;
  std::array<ChannelReplay, replay_channels> channels{};
  std::vector<bool> diverged{};  // each model
  std::string loop, loop_words;  // "given", "fitted", "identified", "approximated", "none"; a sentence
  double loop_error = 0.0;       // of the loop's controller on the measured positions; NaN: unknown
  double horizon_s = 0.0;

  ChannelReplay const& channel(ReplayChannel which) const { return channels[static_cast<std::size_t>(which)]; }
};

struct Replay {
  std::vector<std::string> models{};
  std::size_t before = 0, after = 0;  // of models
  bool is_prismatic = false;
  std::string torque_unit = "N m";
  std::vector<RecordingReplay> recordings{};
};

inline constexpr char const* users_simulator = "your simulator";

// one model on one track
struct ReplayedModel {
  RolloutStructure structure;
  RolloutTrial trial;
};

// velocity: measured, [n] or empty; simulators of the recording's own columns come last
RecordingReplay replay_recording(Recording const& recording, RolloutTrack const& track, Eigen::VectorXd const& velocity,
                                 std::vector<ReplayedModel> const& models);

}  // namespace torquescope
