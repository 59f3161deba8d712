#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& motor_gain_per_kelvin_effect() {
  static DriveEffect const effect{
      .name = "motor_gain_per_kelvin",
      .title = "Motor that weakens with heat",
      .equation = "motor_gain (1 + motor_gain_per_kelvin (T - 25))",
      .confused = "nothing, where temperatures and loads differ independently",
      .kind = DriveEffectKind::drive,
      .keys = {LoopKey::motor_gain_per_kelvin},
      .adds = true,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        if (!of.has_temperatures) return {};
        return {{0.0}};
      },
  };
  return effect;
}

}  // namespace torquescope
