#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& goal_speed_limit_effect() {
  static DriveEffect const effect{
      .name = "goal_speed_limit",
      .title = "Speed limit of the command",
      .equation = "|d goal / dt| <= goal_speed_limit",
      .confused = "goal_acceleration_limit where the goal never runs long; a longer ramp tells",
      .kind = DriveEffectKind::profile,
      .keys = {LoopKey::goal_speed_limit},
      .adds = false,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        return {{0.5 * of.speed}, {0.7 * of.speed}, {0.9 * of.speed}, {1.1 * of.speed}};
      },
  };
  return effect;
}

}  // namespace torquescope
