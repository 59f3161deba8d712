#include "engine/simulate/rollout/drive_laws/drive_laws.hpp"

namespace torquescope {

DriveLaw const& load_friction_law() {
  static DriveLaw const law{
      .name = "load_friction",
      .title = "Load-dependent friction",
      .equation = "F = load_friction load, load = |motor + weight| / 2",
      .confused = "coulomb friction, where all recordings have one load",
      .kind = DriveLawKind::gear,
      .keys = {LoopKey::load_friction},
      .adds = true,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        if (!of.has_load) return {};
        return {{0.0}};
      },
  };
  return law;
}

}  // namespace torquescope
