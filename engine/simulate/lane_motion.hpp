#pragma once
// A joint with its effects over one tick, for all lanes: what the loop gave is held, effects that follow steps are
// asked at every step, the others once for several.
//
// Use        one object per group of lanes and recording: effects remember
// Units      SI; times since the start of the recording
// Accuracy   as replicate_lanes.hpp
// Threads    used by one thread

#include <memory>
#include <vector>

#include "engine/simulate/lane_effect.hpp"
#include "engine/simulate/lane_step.hpp"
#include "engine/simulate/sticking_lanes.hpp"

namespace torquescope {

// how a tick is cut
struct TickSteps {
  double step_s = 0.0;
  std::size_t steps = 1;
  std::size_t held = 1;  // steps for which an effect without a memory is held
};

class LaneMotion {
 public:
  LaneMotion(LaneDryFriction const& dry, std::vector<LaneEffectMaker> const& effects, TickSteps const& steps);

  std::vector<std::unique_ptr<LaneEffect>> const& effects() const { return effects_; }

  // from the next tick on
  void set_dry_friction(LaneDryFriction const& dry) { dry_ = dry; }

  // command: of the motor, as effects see it; acts: on the joint beside them; level: of dry friction, one per lane;
  // sticking: none, where friction holds at once
  void advance_tick(LaneJoints const& joints, double time_s, double const* command, double const* acts,
                    double const* level, LaneSticking* sticking, LaneState& state);

 private:
  void move_on(LaneJoints const& joints, double time_s, std::size_t steps, double const* command, double const* acts,
               double const* level, LaneSticking* sticking, LaneState& state);
  void advance(LaneJoints const& joints, std::size_t steps, LaneSticking* sticking, LaneState& state) const;

  LaneDryFriction dry_;
  std::vector<std::unique_ptr<LaneEffect>> effects_;
  TickSteps steps_;
  bool any_follows_steps_ = false, any_is_held_ = false;
  LaneTorques torques_{};
};

LaneInstant instant_of(LaneState const& state, double time_s, double step_s, double const* motor_torque);

}  // namespace torquescope
