#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& goal_acceleration_limit_effect() {
  static DriveEffect const effect{
      .name = "goal_acceleration_limit",
      .title = "Acceleration limit of the command",
      .equation = "|d2 goal / dt2| <= goal_acceleration_limit",
      .confused = "goal_speed_limit and command_delay where ramps are short; a longer ramp tells",
      .kind = DriveEffectKind::profile,
      .keys = {LoopKey::goal_acceleration_limit},
      .adds = false,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        return {{0.25 * of.acceleration}, {0.5 * of.acceleration}, {of.acceleration}, {2.0 * of.acceleration}};
      },
  };
  return effect;
}

}  // namespace torquescope
