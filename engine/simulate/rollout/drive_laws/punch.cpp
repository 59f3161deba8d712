#include "engine/simulate/rollout/drive_laws/drive_laws.hpp"

namespace torquescope {

DriveLaw const& punch_law() {
  static DriveLaw const law{
      .name = "punch",
      .title = "Least drive",
      .equation = "|command| >= punch where there is an error",
      .confused = "coulomb friction that is smaller; a motion with the drive off tells",
      .kind = DriveLawKind::drive,
      .keys = {LoopKey::punch},
      .adds = false,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        return {{0.03 * of.command}, {0.1 * of.command}, {0.3 * of.command}};
      },
  };
  return law;
}

}  // namespace torquescope
