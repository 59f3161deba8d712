#include "engine/simulate/rollout/drive_laws/drive_laws.hpp"

namespace torquescope {

DriveLaw const& arm_mass_law() {
  static DriveLaw const law{
      .name = "arm_mass",
      .title = "Mass of the arm",
      .equation = "inertia arm_mass L^2 / 3, gravity 9.80665 arm_mass L / 2 sin q",
      .confused = "motor_gain, where all recordings have one load",
      .kind = DriveLawKind::gear,
      .keys = {LoopKey::arm_mass},
      .adds = true,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        if (!of.has_arm) return {};
        return {{0.0}};
      },
  };
  return law;
}

}  // namespace torquescope
