#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& load_motor_share_effect() {
  static DriveEffect const effect{
      .name = "load_motor_share",
      .title = "Whose torque loads the gear",
      .equation = "load = |load_motor_share motor + (1 - load_motor_share) weight|",
      .confused = "nothing, where the joint is led fast under a load; at rest both torques are equal",
      .kind = DriveEffectKind::gear,
      .keys = {LoopKey::load_motor_share},
      .adds = false,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        if (!of.has_load) return {};
        return {{0.2}, {0.8}};
      },
  };
  return effect;
}

}  // namespace torquescope
