#include "engine/simulate/rollout/drive_laws/drive_laws.hpp"

namespace torquescope {

DriveLaw const& torque_limit_law() {
  static DriveLaw const law{
      .name = "torque_limit",
      .title = "Limit of the command",
      .equation = "|command| <= torque_limit",
      .confused = "back_emf where the joint always runs fast at the limit",
      .kind = DriveLawKind::drive,
      .keys = {LoopKey::torque_limit},
      .adds = false,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        return {{of.command}, {1.5 * of.command}, {2.5 * of.command}};
      },
  };
  return law;
}

}  // namespace torquescope
