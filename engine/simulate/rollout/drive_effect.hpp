#pragma once
// An effect of the drive or of the gear, as one or two numbers of a loop: what lies between a reference and the motion
// of a servo. Adding one is a file in drive_effects/ and a line in drive_effects.cpp.
//
// Kinds      profile: between reference and controller; drive: between controller and motor; gear: friction and load
// Starts     of its numbers, in the order of its keys; one that adds begins where it does nothing. The others begin
//            close to that as well: a model that has made up for a lag is no joint beside the whole of it
// Threads    immutable objects, pure functions

#include <span>
#include <vector>

#include "engine/simulate/rollout/loop_form.hpp"
#include "engine/simulate/rollout/track.hpp"

namespace torquescope {

// how large the numbers of a set of recordings are
struct DriveScales {
  double speed = 1.0, acceleration = 1.0;  // that hardly any sample exceeds; rad/s, rad/s2
  double sample_s = 0.01;                  // the shortest of all recordings
  double torque = 1.0;                     // N m, rms
  double error = 0.1, command = 1.0;       // rms of reference - position; of the command that answers it
  double encoder_step = 0.0;
  bool has_load = false, has_several_loads = false;  // known; recordings differ in what hung there
  bool has_arm = false, has_temperatures = false;
};

enum class DriveEffectKind { profile, drive, gear };

struct DriveEffect {
  char const* name;
  char const* title;
  char const* equation;
  char const* confused;  // what it cannot be told from, and what would tell
  DriveEffectKind kind;
  std::vector<LoopKey> keys;  // the first is its own: no other effect has it
  bool adds;                  // its first number begins at zero and leaves the rest as it is
  std::vector<std::vector<double>> (*starts)(DriveScales const&);  // empty: these recordings say nothing of it
  // Samples: a first number of less is within what a recording can tell of when a sample was taken; no name
  double least_samples = 0.0;
};

std::span<DriveEffect const* const> drive_effects();
DriveEffect const& drive_effect_of(LoopKey first);

// fits_weight: the model has a weight of its own, which loads the gear as a known one does
DriveScales drive_scales(std::vector<RolloutTrack> const& tracks, LoopNumbers const& loop, bool fits_weight = false);

}  // namespace torquescope
