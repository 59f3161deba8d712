#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

namespace torquescope {

DriveEffect const& command_delay_effect() {
  static DriveEffect const effect{
      .name = "command_delay",
      .title = "Delay of the command",
      .equation = "goal(t) = reference(t - command_delay)",
      .confused = "torque_lag and torque_delay at a low gain; a faster motion tells",
      .kind = DriveEffectKind::profile,
      .keys = {LoopKey::command_delay_s},
      .adds = false,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        return {{0.1 * of.sample_s}, {0.5 * of.sample_s}, {2.0 * of.sample_s}, {0.02}, {0.06}};
      },
      .least_samples = 0.5,
  };
  return effect;
}

}  // namespace torquescope
