#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& angle_friction_effect() {
  static DriveEffect const effect{
      .name = "angle_friction",
      .title = "Friction over the angle",
      .equation = "F = angle_friction_cos cos(q) + angle_friction_sin sin(q)",
      .confused = "load_friction, where all recordings have one load: the weight turns with the angle as well",
      .kind = DriveEffectKind::gear,
      .keys = {LoopKey::angle_friction_cos, LoopKey::angle_friction_sin},
      .adds = true,
      .starts = [](DriveScales const&) -> std::vector<std::vector<double>> {
        return {{0.0, 0.0}};
      },
  };
  return effect;
}

}  // namespace torquescope
