#include "engine/simulate/lane_motion.hpp"

#include <algorithm>

namespace torquescope {

LaneInstant instant_of(LaneState const& state, double time_s, double step_s, double const* motor_torque) {
  LaneInstant at;
  at.time_s = time_s;
  at.step_s = step_s;
  std::copy_n(state.q, replicate_lanes, at.q);
  std::copy_n(state.dq, replicate_lanes, at.dq);
  std::copy_n(state.ddq, replicate_lanes, at.ddq);
  std::copy_n(motor_torque, replicate_lanes, at.motor_torque);
  return at;
}

LaneMotion::LaneMotion(LaneDryFriction const& dry, std::vector<LaneEffectMaker> const& effects, TickSteps const& steps)
    : dry_(dry), steps_(steps) {
  for (auto const& make : effects) effects_.push_back(make());
  for (auto const& effect : effects_) (effect->follows_steps() ? any_follows_steps_ : any_is_held_) = true;
  if (!any_is_held_) steps_.held = steps_.steps;
}

void LaneMotion::advance(LaneJoints const& joints, std::size_t steps, LaneSticking* sticking, LaneState& state) const {
  if (sticking != nullptr) return advance_sticking_lanes(joints, torques_, steps_.step_s, steps, *sticking, state);
  advance_lanes(joints, torques_, steps_.step_s, steps, state);
}

void LaneMotion::move_on(LaneJoints const& joints, double time_s, std::size_t steps, double const* command,
                         double const* acts, double const* level, LaneSticking* sticking, LaneState& state) {
  LaneDemand of_held;
  if (any_is_held_) {
    LaneInstant middle = instant_of(state, time_s, static_cast<double>(steps) * steps_.step_s, command);
    foresee_lanes(state, middle);
    for (auto const& effect : effects_)
      if (!effect->follows_steps()) effect->add(middle, of_held);
  }
  if (!any_follows_steps_) {
    load_lanes(joints.inertia, dry_, acts, level, of_held, state, torques_);
    return advance(joints, steps, sticking, state);
  }
  LaneInstant at;  // in the middle of a step
  at.step_s = steps_.step_s;
  std::copy_n(command, replicate_lanes, at.motor_torque);
  for (std::size_t step = 0; step < steps; ++step) {
    at.time_s = time_s + static_cast<double>(step) * steps_.step_s;
    foresee_lanes(state, at);
    LaneDemand demand = of_held;
    for (auto const& effect : effects_)
      if (effect->follows_steps()) effect->add(at, demand);
    load_lanes(joints.inertia, dry_, acts, level, demand, state, torques_);
    advance(joints, 1, sticking, state);
  }
}

void LaneMotion::advance_tick(LaneJoints const& joints, double time_s, double const* command, double const* acts,
                              double const* level, LaneSticking* sticking, LaneState& state) {
  for (std::size_t step = 0; step < steps_.steps; step += steps_.held)
    move_on(joints, time_s + static_cast<double>(step) * steps_.step_s, std::min(steps_.held, steps_.steps - step),
            command, acts, level, sticking, state);
}

}  // namespace torquescope
