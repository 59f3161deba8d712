#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& load_friction_effect() {
  static DriveEffect const effect{
      .name = "load_friction",
      .title = "Load-dependent friction",
      .equation = "F = load_friction load, load = |motor + weight| / 2",
      .confused = "coulomb friction, where all recordings have one load",
      .kind = DriveEffectKind::gear,
      .keys = {LoopKey::load_friction},
      .adds = true,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        if (!of.has_load) return {};
        return {{0.0}};
      },
  };
  return effect;
}

}  // namespace torquescope
