#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& torque_lag_effect() {
  static DriveEffect const effect{
      .name = "torque_lag",
      .title = "Lag of the motor",
      .equation = "motor torque through a low-pass of torque_lag",
      .confused = "command_delay; another gain tells",
      .kind = DriveEffectKind::drive,
      .keys = {LoopKey::torque_lag_s},
      .adds = false,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        return {{0.1 * of.sample_s}, {0.3 * of.sample_s}, {1.0 * of.sample_s}, {2.5 * of.sample_s}};
      },
  };
  return effect;
}

}  // namespace torquescope
