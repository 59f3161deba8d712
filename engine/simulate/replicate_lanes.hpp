#pragma once
// The equation of motion of a joint for many replicates at once, side by side in vector registers.
//
// Equation   (inertia + added) ddq = held - viscous dq - (g_sin sin q + g_cos cos q) - dry,
//              dry = forward while dq > 0, backward while dq < 0, anything in [backward, forward] at rest
// Steps      second-order Taylor while sliding; where a velocity meets zero the step is cut, and its rest begins with
//            the question whether friction holds (set-valued, no smoothing). Gravity: third-order Taylor, error (q -
//            q0)^4 / 24 of the weight, 3e-12 at 3 rad/s and 1 kHz
// Shapes     replicate_lanes replicates or trials, one lane each; unused lanes may hold anything finite
// Units      SI; held, forward, backward in N m or N
// Bits       the same on every instruction set: additions and multiplications only, no fused ones
// Requires   inertia + added > 0, backward <= forward, viscous step / (inertia + added) < 1
// Threads    any number, each with its own state; does not allocate

#include <cstddef>

namespace torquescope {

inline constexpr std::size_t replicate_lanes = 16;

struct LaneState {
  alignas(64) double q[replicate_lanes] = {};
  alignas(64) double dq[replicate_lanes] = {};
  alignas(64) double ddq[replicate_lanes] = {};  // at the start of the last step; 0 while friction holds
};

// constant during a call
struct LaneTorques {
  alignas(
      64) double held[replicate_lanes] = {};  // motor and disturbance, less whatever else does not depend on dq here
  alignas(64) double forward[replicate_lanes] = {};
  alignas(64) double backward[replicate_lanes] = {};
  alignas(64) double added_inertia[replicate_lanes] = {};
};

struct LaneJoint {
  double inertia = 1.0, viscous = 0.0, gravity_sin = 0.0, gravity_cos = 0.0;
};

// one joint a lane: replicates have the same in all, trials of a fit each its own
struct LaneJoints {
  alignas(64) double inertia[replicate_lanes] = {};
  alignas(64) double viscous[replicate_lanes] = {};
  alignas(64) double gravity_sin[replicate_lanes] = {};
  alignas(64) double gravity_cos[replicate_lanes] = {};
  bool has_weight = false;  // any lane

  LaneJoints() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a joint is itself in every lane
  LaneJoints(LaneJoint const& same);
  void set(std::size_t lane, LaneJoint const& joint);
};

// `steps` steps of step_s each
void advance_lanes(LaneJoints const& joints, LaneTorques const& torques, double step_s, std::size_t steps,
                   LaneState& state);

}  // namespace torquescope
