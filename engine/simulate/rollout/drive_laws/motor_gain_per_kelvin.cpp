#include "engine/simulate/rollout/drive_laws/drive_laws.hpp"

namespace torquescope {

DriveLaw const& motor_gain_per_kelvin_law() {
  static DriveLaw const law{
      .name = "motor_gain_per_kelvin",
      .title = "Motor that weakens with heat",
      .equation = "motor_gain (1 + motor_gain_per_kelvin (T - 25))",
      .confused = "nothing, where temperatures and loads differ independently",
      .kind = DriveLawKind::drive,
      .keys = {LoopKey::motor_gain_per_kelvin},
      .adds = true,
      .starts = [](DriveScales const& of) -> std::vector<std::vector<double>> {
        if (!of.has_temperatures) return {};
        return {{0.0}};
      },
  };
  return law;
}

}  // namespace torquescope
