#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& load_stribeck_friction_effect() {
  static DriveEffect const effect{
      .name = "load_stribeck_friction",
      .title = "Stribeck friction that grows with the load",
      .equation = "F = load_stribeck_friction b(dq / stribeck_speed) load",
      .confused = "stribeck_friction, where all recordings have one load",
      .kind = DriveEffectKind::gear,
      .keys = {LoopKey::load_stribeck_friction, LoopKey::stribeck_speed},
      .adds = true,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        if (!of.has_load) return {};
        return {{0.0, 0.02 * of.speed}, {0.0, 0.1 * of.speed}, {0.0, 0.3 * of.speed}};
      },
  };
  return effect;
}

}  // namespace torquescope
