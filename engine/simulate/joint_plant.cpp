#include "engine/simulate/joint_plant.hpp"

#include "engine/base/contract.hpp"

namespace torquescope {

double JointPlant::inertia(JointState const& state) const { return effects_.smooth(state).inertia; }

HoldRange JointPlant::hold_range(JointState const& state) const {
  JointState rest = state;
  rest.dq = 0.0;
  double const smooth = effects_.smooth(rest).coasting;
  return {smooth + effects_.dry(rest, -1.0), smooth + effects_.dry(rest, 1.0)};
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
  JointEffects::SmoothPart const smooth = effects_.smooth(state);
  return (u - smooth.coasting - effects_.dry(state, direction)) / smooth.inertia;
}

double JointPlant::acceleration(JointState const& state, double u) const {
  double const direction = direction_of_motion(state, u);
  return direction == 0.0 ? 0.0 : sliding_acceleration(state, u, direction);
}

double JointPlant::inverse_dynamics(JointState const& state) const { return effects_.torque(state); }

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
