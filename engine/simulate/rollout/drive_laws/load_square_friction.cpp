#include "engine/simulate/rollout/drive_laws/drive_laws.hpp"

namespace torquescope {

DriveLaw const& load_square_friction_law() {
  static DriveLaw const law{
      .name = "load_square_friction",
      .title = "Friction by the square of the load",
      .equation = "F = load_square_friction load^2",
      .confused = "load_friction, where loads differ by less than twice",
      .kind = DriveLawKind::gear,
      .keys = {LoopKey::load_square_friction},
      .adds = true,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        if (!of.has_load) return {};
        return {{0.0}};
      },
  };
  return law;
}

}  // namespace torquescope
