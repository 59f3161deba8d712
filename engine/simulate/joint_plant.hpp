#pragma once
// The equation of motion of one joint, made of effects, with dry friction as the set-valued law it is.
//
// Equation   J(q, t) ddq = u - smooth(q, dq, t) - dry,
//              dry = dry_torque(dq)                           while the joint moves
//              dry in [dry_torque(0-), dry_torque(0+)]        at rest: whatever keeps it there, within this range
// Parts      J is what the effects ask per unit of acceleration; dry: effects with is_dry_friction(), seen at ddq = 0
// Units      SI; u is the motor torque at the joint (N m or N)
// Threads    const object, any number of threads; advance() does not allocate

#include <vector>

#include "engine/simulate/joint_effects.hpp"

namespace torquescope {

// the motor torques that leave a resting joint at rest; empty (low > high) when the "friction" would drive the joint
struct HoldRange {
  double low = 0.0, high = 0.0;
};

class JointPlant {
 public:
  explicit JointPlant(std::vector<PlantTerm> const& terms) : effects_(terms) {}

  double inertia(JointState const& state) const;
  HoldRange hold_range(JointState const& state) const;           // as if at rest at this position and time
  double acceleration(JointState const& state, double u) const;  // just after this instant; 0 while held
  double inverse_dynamics(JointState const& state) const;        // u that makes this motion; sign(0) = 0

  // One step under a constant u: midpoint rule while the joint slides in one direction; where the velocity meets zero
  // the step is cut, the velocity set to zero, and the rest of the step begins with the question whether friction
  // holds. Accuracy   second order in step_s, through reversals and stops too Returns    the state after the step, ddq
  // = 0 (ask acceleration())
  JointState advance(JointState const& state, double u, double step_s) const;

 private:
  double direction_of_motion(JointState const& state, double u) const;  // -1, 0 (held), 1
  double sliding_acceleration(JointState const& state, double u, double direction) const;
  JointState slide(JointState const& state, double u, double direction, double step_s) const;

  JointEffects effects_;
};

}  // namespace torquescope
