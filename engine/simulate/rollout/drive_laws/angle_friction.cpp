#include "engine/simulate/rollout/drive_laws/drive_laws.hpp"

namespace torquescope {

DriveLaw const& angle_friction_law() {
  static DriveLaw const law{
      .name = "angle_friction",
      .title = "Friction over the angle",
      .equation = "F = angle_friction_cos cos(q) + angle_friction_sin sin(q)",
      .confused = "load_friction, where all recordings have one load: the weight turns with the angle as well",
      .kind = DriveLawKind::gear,
      .keys = {LoopKey::angle_friction_cos, LoopKey::angle_friction_sin},
      .adds = true,
      .starts = [](DriveScales const&) -> std::vector<std::vector<double>> {
        return {{0.0, 0.0}};
      },
  };
  return law;
}

}  // namespace torquescope
