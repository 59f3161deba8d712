#include "engine/simulate/rollout/drive_laws/drive_laws.hpp"

namespace torquescope {

DriveLaw const& load_motor_share_law() {
  static DriveLaw const law{
      .name = "load_motor_share",
      .title = "Whose torque loads the gear",
      .equation = "load = |load_motor_share motor + (1 - load_motor_share) weight|",
      .confused = "nothing, where the joint is led fast under a load; at rest both torques are equal",
      .kind = DriveLawKind::gear,
      .keys = {LoopKey::load_motor_share},
      .adds = false,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        if (!of.has_load) return {};
        return {{0.2}, {0.8}};
      },
  };
  return law;
}

}  // namespace torquescope
