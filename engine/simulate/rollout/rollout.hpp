#pragma once
// Simulates up to sixteen trials of a joint in its loop along one track: positions, speeds and torques at every sample.
//
// Trial      one lane: a joint, its effects' parameters, its loop, and where it begins beside the measured state
// Fast       a joint without effects in a loop of numbers stays in vector registers (loop_lanes.hpp); effects of the
//            catalogue or an identified controller are asked tick by tick, in all lanes: last digits differ then
// Diverged   a lane that leaves a hundred times the track's range, or is no number: NaN from then on
// Units      SI of the joint's kind
// Bits       of a trial: the same whatever stands beside it, on any number of threads and any instruction set
// Threads    const objects; any number of calls side by side

#include <functional>
#include <span>
#include <vector>

#include "engine/effects/effect.hpp"
#include "engine/simulate/replicate_lanes.hpp"
#include "engine/simulate/rollout/gear_friction.hpp"
#include "engine/simulate/rollout/loop_numbers.hpp"
#include "engine/simulate/rollout/track.hpp"

namespace torquescope {

// what all trials of a model share
struct RolloutStructure {
  std::vector<Effect const*> effects{};
  JointScales scales{};
  std::size_t hold_ticks = 1;     // of a controller slower than the ticks
  std::size_t speed_samples = 1;  // that the controller's difference of the position spans; 0: it sees the speed
  double step_s = 1e-3;           // of the integration, at most
};

struct RolloutTrial {
  LaneJoint joint{};
  double forward = 0.0, backward = 0.0;  // dry friction
  double offset = 0.0;
  GearFriction gear{};
  double arm_mass = 0.0, motor_gain_per_kelvin = 0.0;  // for what is known of a track (track_known.hpp)
  std::vector<std::vector<double>> effects{};          // of each, as Effect::runner takes them
  LoopNumbers loop{};
  double position_step = 0.0, velocity_step = 0.0;  // beside the measured start
  double encoder_step = 0.0, encoder_phase = 0.0;   // that the loop and the record read by; 0: exactly
  bool is_possible = true;  // false: no inertia, or dry friction that would drive; it is not simulated
};

// rows of samples [first, first + samples): [samples][replicate_lanes]
struct RolloutRows {
  Eigen::Index first = 0, samples = 0;
  double const* position = nullptr;
  double const* velocity = nullptr;
  double const* torque = nullptr;
};
using RolloutSink = std::function<void(RolloutRows const&)>;

// 1 <= trials.size() <= replicate_lanes; lanes beyond the last hold anything
void roll_out(RolloutTrack const& track, RolloutStructure const& structure, std::span<RolloutTrial const> trials,
              RolloutSink const& sink);

// a step short enough for this joint: at a fiftieth of its fastest time the second order leaves 7e-5
double longest_step_s(RolloutTrial const& trial, RolloutStructure const& structure, double tick_s);

}  // namespace torquescope
