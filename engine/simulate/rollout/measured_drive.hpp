#pragma once
// What a drive commands and how its joint moves, read off a recording: no simulation.
//
// Command    gain (kp (goal - position) + kd (goal's speed - speed)) between its limits; 0 while the drive is off
// Motion     differences over a twentieth of a second, in which an encoder's steps hardly show
// Shapes     [n] of the track's samples; speed and acceleration are NaN so close to the end of a segment
// Units      SI; the command in the drive's own
// Threads    pure function

#include "engine/simulate/rollout/loop_numbers.hpp"
#include "engine/simulate/rollout/track.hpp"

namespace torquescope {

struct MeasuredDrive {
  Eigen::VectorXd command{}, speed{}, acceleration{};
};

// command is empty where the track has no reference
MeasuredDrive measured_drive(RolloutTrack const& track, LoopNumbers const& loop);

inline bool is_drive_on(RolloutTrack const& track, Eigen::Index sample) {
  return track.enabled.size() == 0 || track.enabled[sample] != 0.0;
}

}  // namespace torquescope
