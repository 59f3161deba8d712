#pragma once
// Effects of one joint, sorted by what an equation of motion needs of them.
//
// Equation   torque = inertia ddq + coasting + dry; dry jumps with the sign of dq and is set-valued at rest
// Parts      dry: effects with is_dry_friction(), seen at ddq = 0; the others: inertia is torque per unit of ddq
// Units      SI of the joint
// Threads    const object, any number of threads; no allocation

#include <vector>

#include "engine/effects/effect.hpp"

namespace torquescope {

// one effect with a value for each of its parameters
struct PlantTerm {
  Effect const* effect = nullptr;
  std::vector<double> parameters;
};

class JointEffects {
 public:
  // Requires   effects without memory that act on the joint
  explicit JointEffects(std::vector<PlantTerm> const& terms);

  struct SmoothPart {
    double inertia = 0.0, coasting = 0.0;
  };
  SmoothPart smooth(JointState const& state) const;
  double dry(JointState const& state, double direction) const;  // of the branch that moves in `direction`
  double torque(JointState const& state) const;                 // of all; sign(0) = 0
  bool has_dry() const { return !dry_terms_.empty(); }
  JointScales const& scales() const { return scales_; }  // Coulomb levels

 private:
  std::vector<PlantTerm> smooth_terms_, dry_terms_;
  JointScales scales_;
};

}  // namespace torquescope
