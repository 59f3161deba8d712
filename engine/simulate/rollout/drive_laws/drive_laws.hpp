#pragma once
// One function for each law of drive and gear; drive_laws.cpp says in which order a ladder asks them.
//
// Threads    immutable objects

#include "engine/simulate/rollout/drive_law.hpp"

namespace torquescope {

DriveLaw const& goal_speed_limit_law();
DriveLaw const& goal_acceleration_limit_law();
DriveLaw const& command_delay_law();
DriveLaw const& torque_lag_law();
DriveLaw const& dead_band_law();
DriveLaw const& punch_law();
DriveLaw const& torque_limit_law();
DriveLaw const& motor_gain_per_kelvin_law();
DriveLaw const& load_friction_law();
DriveLaw const& load_square_friction_law();
DriveLaw const& stribeck_friction_law();
DriveLaw const& load_stribeck_friction_law();
DriveLaw const& arm_mass_law();
DriveLaw const& load_motor_share_law();
DriveLaw const& angle_friction_law();

}  // namespace torquescope
