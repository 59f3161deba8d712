#pragma once
// What goes round the equation of motion of one step of replicates, side by side in vector registers.
//
// Why        an effect that follows steps is asked ten times in a tick. A vector that is loaded from what was just
//            stored in smaller pieces waits until these are in the cache, so that everything between two steps is done
//            in vectors
// Bits       the same on every instruction set: one rounding per operation, no fused ones
// Threads    free functions

#include "engine/simulate/lane_effect.hpp"
#include "engine/simulate/replicate_lanes.hpp"

namespace torquescope {

// half of at.step_s on from `state`, straight ahead; a velocity does not turn in it. at: with its time, step and motor
// torque
void foresee_lanes(LaneState const& state, LaneInstant& at);

// dry friction of the joint by itself, at its level of 1
struct LaneDryFriction {
  alignas(64) double forward[replicate_lanes] = {};
  alignas(64) double backward[replicate_lanes] = {};

  LaneDryFriction() = default;
  LaneDryFriction(double forward, double backward);  // the same in all lanes
};

// inertia: of the joint, one per lane; held: torque that acts during the tick; level: of the joint's own friction, one
// per lane; demand: of the effects
void load_lanes(double const* inertia, LaneDryFriction const& friction, double const* held, double const* level,
                LaneDemand const& demand, LaneState const& state, LaneTorques& torques);

// sum += torque
void add_lanes(double const* torque, double* sum);

// a torque that is straight in the acceleration, told at 0 and at 1
void add_straight(double const* coasting, double const* at_one, LaneDemand& demand);

}  // namespace torquescope
