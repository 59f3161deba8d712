#include "engine/simulate/rollout/drive_laws/drive_laws.hpp"

#include <algorithm>
#include <array>

#include "engine/base/contract.hpp"

namespace torquescope {

std::span<DriveLaw const* const> drive_laws() {
  static std::array<DriveLaw const*, 15> const laws{&goal_speed_limit_law(),  &goal_acceleration_limit_law(),
                                                    &command_delay_law(),     &torque_lag_law(),
                                                    &dead_band_law(),         &punch_law(),
                                                    &torque_limit_law(),      &motor_gain_per_kelvin_law(),
                                                    &load_friction_law(),     &load_square_friction_law(),
                                                    &stribeck_friction_law(), &load_stribeck_friction_law(),
                                                    &arm_mass_law(),          &load_motor_share_law(),
                                                    &angle_friction_law()};
  return laws;
}

DriveLaw const& drive_law_of(LoopKey first) {
  auto const laws = drive_laws();
  auto const law = std::find_if(laws.begin(), laws.end(), [&](DriveLaw const* one) { return one->keys[0] == first; });
  TORQUESCOPE_EXPECT(law != laws.end());
  return **law;
}

}  // namespace torquescope
