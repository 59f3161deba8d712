#include "engine/rollout/drive_laws/drive_laws.hpp"

namespace torquescope {

DriveLaw const& punch_law() {
  static DriveLaw const law{
      .name = "punch",
      .title = "Least drive",
      .equation = "|command| >= punch where there is an error",
      .confused = "coulomb friction that is smaller; a motion with the drive off tells",
      .kind = DriveLawKind::drive,
      .keys = {LoopKey::punch},
      .adds = true,
      .starts = [](DriveScales const&) -> std::vector<std::vector<double>> { return {{0.0}}; },
  };
  return law;
}

}  // namespace torquescope
