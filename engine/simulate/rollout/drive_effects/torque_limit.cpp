#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& torque_limit_effect() {
  static DriveEffect const effect{
      .name = "torque_limit",
      .title = "Limit of the command",
      .equation = "|command| <= torque_limit",
      .confused = "back_emf where the joint always runs fast at the limit",
      .kind = DriveEffectKind::drive,
      .keys = {LoopKey::torque_limit},
      .adds = false,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        return {{of.command}, {1.5 * of.command}, {2.5 * of.command}};
      },
  };
  return effect;
}

}  // namespace torquescope
