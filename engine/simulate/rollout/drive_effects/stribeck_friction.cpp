#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& stribeck_friction_effect() {
  static DriveEffect const effect{
      .name = "stribeck_friction",
      .title = "Stribeck friction",
      .equation = "F = stribeck_friction b(dq / stribeck_speed), b = (1 + x^2 / 16)^-16",
      .confused = "coulomb friction, where the joint never creeps",
      .kind = DriveEffectKind::gear,
      .keys = {LoopKey::stribeck_friction, LoopKey::stribeck_speed},
      .adds = true,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        return {{0.0, 0.02 * of.speed}, {0.0, 0.1 * of.speed}, {0.0, 0.3 * of.speed}};
      },
  };
  return effect;
}

}  // namespace torquescope
