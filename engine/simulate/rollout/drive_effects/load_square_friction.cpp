#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& load_square_friction_effect() {
  static DriveEffect const effect{
      .name = "load_square_friction",
      .title = "Friction by the square of the load",
      .equation = "F = load_square_friction load^2",
      .confused = "load_friction, where loads differ by less than twice",
      .kind = DriveEffectKind::gear,
      .keys = {LoopKey::load_square_friction},
      .adds = true,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        if (!of.has_load) return {};
        return {{0.0}};
      },
  };
  return effect;
}

}  // namespace torquescope
