#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& arm_mass_effect() {
  static DriveEffect const effect{
      .name = "arm_mass",
      .title = "Mass of the arm",
      .equation = "inertia arm_mass L^2 / 3, gravity 9.80665 arm_mass L / 2 sin q",
      .confused = "motor_gain, where all recordings have one load",
      .kind = DriveEffectKind::gear,
      .keys = {LoopKey::arm_mass},
      .adds = true,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        if (!of.has_arm) return {};
        return {{0.0}};
      },
  };
  return effect;
}

}  // namespace torquescope
