#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& punch_effect() {
  static DriveEffect const effect{
      .name = "punch",
      .title = "Least drive",
      .equation = "|command| >= punch where there is an error",
      .confused = "coulomb friction that is smaller; a motion with the drive off tells",
      .kind = DriveEffectKind::drive,
      .keys = {LoopKey::punch},
      .adds = false,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        return {{0.03 * of.command}, {0.1 * of.command}, {0.3 * of.command}};
      },
  };
  return effect;
}

}  // namespace torquescope
