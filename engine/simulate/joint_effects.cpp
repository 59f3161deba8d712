#include "engine/simulate/joint_effects.hpp"

#include <algorithm>
#include <limits>

#include "engine/base/contract.hpp"

namespace torquescope {

JointEffects::JointEffects(std::vector<PlantTerm> const& terms) {
  for (auto const& term : terms) {
    TORQUESCOPE_EXPECT(term.effect && term.parameters.size() == term.effect->parameters().size());
    TORQUESCOPE_EXPECT(!term.effect->has_memory() && term.effect->acts_on() == ActsOn::joint);
    (term.effect->is_dry_friction() ? dry_terms_ : smooth_terms_).push_back(term);
  }

  // the levels that friction with an effect of its own is shared out by
  for (auto const& term : dry_terms_) {
    if (term.effect->family() != EffectFamily::baseline) continue;
    scales_.coulomb_positive += term.effect->torque({.dq = 1.0}, term.parameters, {});
    scales_.coulomb_negative -= term.effect->torque({.dq = -1.0}, term.parameters, {});
  }
}

JointEffects::SmoothPart JointEffects::smooth(JointState const& state) const {
  JointState coasting = state;
  coasting.ddq = 0.0;
  JointState accelerating = state;
  accelerating.ddq = 1.0;
  SmoothPart sum;
  for (auto const& term : smooth_terms_) {
    double const torque = term.effect->torque(coasting, term.parameters, scales_);
    sum.coasting += torque;
    sum.inertia += term.effect->torque(accelerating, term.parameters, scales_) - torque;
  }
  return sum;
}

double JointEffects::dry(JointState const& state, double direction) const {
  // never zero, never of the other sign: the limit of the branch where it meets rest
  JointState sliding = state;
  sliding.dq = direction * std::max(direction * state.dq, std::numeric_limits<double>::min());
  sliding.ddq = 0.0;
  double sum = 0.0;
  for (auto const& term : dry_terms_) sum += term.effect->torque(sliding, term.parameters, scales_);
  return sum;
}

double JointEffects::torque(JointState const& state) const {
  double sum = 0.0;
  for (auto const& term : smooth_terms_) sum += term.effect->torque(state, term.parameters, scales_);
  for (auto const& term : dry_terms_) sum += term.effect->torque(state, term.parameters, scales_);
  return sum;
}

}  // namespace torquescope
