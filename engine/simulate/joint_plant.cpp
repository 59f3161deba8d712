#include "engine/simulate/joint_plant.hpp"

#include <algorithm>
#include <limits>

#include "engine/base/contract.hpp"

namespace torquescope {

JointPlant::JointPlant(std::vector<PlantTerm> const& terms) {
  for (auto const& term : terms) {
    TORQUESCOPE_EXPECT(term.effect && term.parameters.size() == term.effect->parameters().size());
    TORQUESCOPE_EXPECT(!term.effect->has_memory() && term.effect->acts_on() == ActsOn::joint);
    (term.effect->is_dry_friction() ? dry_terms_ : smooth_terms_).push_back(term);
  }

  // the levels that friction with a law of its own is shared out by
  for (auto const& term : dry_terms_) {
    if (term.effect->family() != EffectFamily::baseline) continue;
    scales_.coulomb_positive += term.effect->torque({.dq = 1.0}, term.parameters, {});
    scales_.coulomb_negative -= term.effect->torque({.dq = -1.0}, term.parameters, {});
  }
}

JointPlant::SmoothPart JointPlant::smooth_part(JointState const& state) const {
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

double JointPlant::inertia(JointState const& state) const { return smooth_part(state).inertia; }

double JointPlant::dry_torque(JointState const& state, double direction) const {
  // never zero, never of the other sign: the limit of the branch where it meets rest
  JointState sliding = state;
  sliding.dq = direction * std::max(direction * state.dq, std::numeric_limits<double>::min());
  sliding.ddq = 0.0;
  double sum = 0.0;
  for (auto const& term : dry_terms_) sum += term.effect->torque(sliding, term.parameters, scales_);
  return sum;
}

HoldRange JointPlant::hold_range(JointState const& state) const {
  JointState rest = state;
  rest.dq = 0.0;
  double const smooth = smooth_part(rest).coasting;
  return {smooth + dry_torque(rest, -1.0), smooth + dry_torque(rest, 1.0)};
}

double JointPlant::direction_of_motion(JointState const& state, double u) const {
  if (state.dq > 0.0) return 1.0;
  if (state.dq < 0.0) return -1.0;
  HoldRange const hold = hold_range(state);
  if (u > hold.high) return 1.0;
  if (u < hold.low) return -1.0;
  return 0.0;
}

double JointPlant::sliding_acceleration(JointState const& state, double u, double direction) const {
  SmoothPart const smooth = smooth_part(state);
  return (u - smooth.coasting - dry_torque(state, direction)) / smooth.inertia;
}

double JointPlant::acceleration(JointState const& state, double u) const {
  double const direction = direction_of_motion(state, u);
  return direction == 0.0 ? 0.0 : sliding_acceleration(state, u, direction);
}

double JointPlant::inverse_dynamics(JointState const& state) const {
  double sum = 0.0;
  for (auto const& term : smooth_terms_) sum += term.effect->torque(state, term.parameters, scales_);
  for (auto const& term : dry_terms_) sum += term.effect->torque(state, term.parameters, scales_);
  return sum;
}

JointState JointPlant::slide(JointState const& state, double u, double direction, double step_s) const {
  double const half_s = 0.5 * step_s;
  JointState middle = state;
  middle.time_s += half_s;
  middle.q += half_s * state.dq;
  middle.dq += half_s * sliding_acceleration(state, u, direction);

  JointState next = state;
  next.time_s += step_s;
  next.q += step_s * middle.dq;
  next.dq += step_s * sliding_acceleration(middle, u, direction);
  next.ddq = 0.0;
  return next;
}

JointState JointPlant::advance(JointState const& start, double u, double step_s) const {
  TORQUESCOPE_EXPECT(step_s > 0.0);
  JointState state = start;
  state.ddq = 0.0;
  double left_s = step_s;
  while (left_s > 0.0) {
    double const direction = direction_of_motion(state, u);
    if (direction == 0.0) break;
    JointState const next = slide(state, u, direction, left_s);
    if (next.dq * direction >= 0.0) return next;
    // pushed off and back within one step: friction would have held it
    if (state.dq == 0.0) break;

    // cut the step where the velocity meets zero
    double const sliding_s = left_s * (state.dq / (state.dq - next.dq));
    state = slide(state, u, direction, sliding_s);
    state.dq = 0.0;
    left_s -= sliding_s;
  }
  state.time_s = start.time_s + step_s;
  return state;
}

}  // namespace torquescope
