#include "engine/simulate/rollout/drive_effects/drive_effects.hpp"

#include <algorithm>
#include <array>

#include "engine/base/contract.hpp"

namespace torquescope {

std::span<DriveEffect const* const> drive_effects() {
  static std::array<DriveEffect const*, 15> const effects{
      &goal_speed_limit_effect(),  &goal_acceleration_limit_effect(),
      &command_delay_effect(),     &torque_lag_effect(),
      &dead_band_effect(),         &punch_effect(),
      &torque_limit_effect(),      &motor_gain_per_kelvin_effect(),
      &load_friction_effect(),     &load_square_friction_effect(),
      &stribeck_friction_effect(), &load_stribeck_friction_effect(),
      &arm_mass_effect(),          &load_motor_share_effect(),
      &angle_friction_effect()};
  return effects;
}

DriveEffect const& drive_effect_of(LoopKey first) {
  auto const effects = drive_effects();
  auto const effect =
      std::find_if(effects.begin(), effects.end(), [&](DriveEffect const* one) { return one->keys[0] == first; });
  TORQUESCOPE_EXPECT(effect != effects.end());
  return **effect;
}

}  // namespace torquescope
