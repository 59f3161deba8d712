#pragma once
// Recordings of a decision as tracks in their loop, and which controller led them.
//
// Controller the job's; where it names none, the plainest gain of the position's error, or of error and speed, that
//            answers as closely as the controller found in the recording does; else that controller
// Channels   the job's; a torque that a gain of the position's error alone answers exactly was computed from it and is
//            no second channel
// Error      of the loop's controller on the measured positions of the first recording; NaN: with an integral
// Errors     Error 65 as track_of()
// Threads    pure functions

#include <span>
#include <vector>

#include "engine/data/recording.hpp"
#include "engine/infer/decision/decision_numbers.hpp"
#include "engine/simulate/rollout/loop_options.hpp"

namespace torquescope {

struct LoopTracks {
  std::vector<RolloutTrack> training{}, validation{};  // those with a reference
  LoopSetting setting{};
  CountedChannels counts{true, true};
  double loop_error = 0.0;
};

LoopTracks loop_tracks(std::span<Recording const> training, std::span<Recording const> validation,
                       LoopOptions const& loop, DecisionNumbers const& numbers);

}  // namespace torquescope
