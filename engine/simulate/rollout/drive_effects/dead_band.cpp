#include <algorithm>

#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& dead_band_effect() {
  static DriveEffect const effect{
      .name = "dead_band",
      .title = "Dead band of the drive",
      .equation = "no command while |error| <= dead_band",
      .confused = "coulomb friction at one gain; another gain tells",
      .kind = DriveEffectKind::drive,
      .keys = {LoopKey::dead_band},
      .adds = false,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        double const step = std::max(of.encoder_step, 5e-3 * of.error);
        return {{4.0 * step}, {12.0 * step}, {36.0 * step}};
      },
  };
  return effect;
}

}  // namespace torquescope
