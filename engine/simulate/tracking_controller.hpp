#pragma once
// A stiff loop of our own round a measured motion, for recordings that have no reference.
//
// Equation   all poles of the frictionless joint at -2 pi bandwidth_hz; what the fitted joint needs for the motion
//            itself is fed forward: inertia, viscous and dry friction, gravity. The motion has in it how the
//            recording's own loop fought with friction at reversals: a loop that learned of friction by its error alone
//            would fight once more, and shake the joint there half as much again
// Dry        tanh(v / slow): where the measured velocity may be noise alone its sign is not fed forward
// Units      SI; bandwidth Hz
// Requires   inertia > 0, slow > 0, bandwidth_hz < 0.05 rate_hz (a faster one rings on the backward difference)
// Threads    free function

#include "engine/simulate/loop_controller.hpp"

namespace torquescope {

// what such a loop knows of the joint: of the terms of a ReplicateJoint, those that it feeds forward
struct TrackedJoint {
  double inertia = 1.0, viscous = 0.0;
  double forward = 0.0, backward = 0.0;  // torque of dry friction while dq > 0, and while dq < 0; with the offset
  double gravity_sin = 0.0, gravity_cos = 0.0;
};

struct TrackedMotion {
  double rate_hz = 0.0;
  double slow = 1.0;  // rad/s or m/s: what the noise of the measured velocity could be
};

// answers errors of position and velocity alone, with these poles; nothing is fed forward
LoopController error_controller(double inertia, double bandwidth_hz, double rate_hz);
LoopController tracking_controller(TrackedJoint const& joint, double bandwidth_hz, TrackedMotion const& motion);

}  // namespace torquescope
