#pragma once
// What rollouts of trials leave of the measured channels: sums for a search, samples for a fit.
//
// Channels   position and torque, each with its own sum; a track that its torque drives has none of the torque
// Diverged   infinite sums; samples of a diverged trial are NaN
// Shapes     samples: [samples of all segments][trials]
// Bits       sums run over time, lane by lane: the same for any neighbours and threads
// Threads    spread over `threads` of base/parallel; const objects

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "engine/simulate/rollout/rollout.hpp"

namespace torquescope {

inline constexpr std::size_t n_channels = 2;  // position, torque
using ChannelNumbers = std::array<double, n_channels>;
// which channels count
using CountedChannels = std::array<bool, n_channels>;

struct TrackResiduals {
  std::array<Eigen::MatrixXd, n_channels> samples;  // measured - simulated; empty: does not count
};

// a set of tracks with one model; every track knows its steps
struct RolloutTask {
  std::vector<RolloutTrack> const& tracks;
  std::vector<RolloutStructure> structures;  // one per track
  CountedChannels counts{true, true};

  bool count(std::size_t track, std::size_t channel) const {
    return counts[channel] && (channel == 0 || tracks[track].drive == TrackDrive::reference);
  }
};

// sums of squares of each trial over all tracks; trials.size() may be any
std::vector<ChannelNumbers> sums_of_squares(RolloutTask const& task, std::span<RolloutTrial const> trials, int threads);

// one per track; trials.size() may be any. per_track: of each track its own trials; all of one number
std::vector<TrackResiduals> residuals_of(RolloutTask const& task,
                                         std::vector<std::vector<RolloutTrial>> const& per_track, int threads);

}  // namespace torquescope
