#pragma once
// One function for each effect of drive and gear; drive_effects.cpp says in which order a ladder asks them.
//
// Threads    immutable objects

#include "engine/simulate/rollout/drive_effect.hpp"

namespace torquescope {

DriveEffect const& goal_speed_limit_effect();
DriveEffect const& goal_acceleration_limit_effect();
DriveEffect const& command_delay_effect();
DriveEffect const& torque_lag_effect();
DriveEffect const& dead_band_effect();
DriveEffect const& punch_effect();
DriveEffect const& torque_limit_effect();
DriveEffect const& motor_gain_per_kelvin_effect();
DriveEffect const& load_friction_effect();
DriveEffect const& load_square_friction_effect();
DriveEffect const& stribeck_friction_effect();
DriveEffect const& load_stribeck_friction_effect();
DriveEffect const& arm_mass_effect();
DriveEffect const& load_motor_share_effect();
DriveEffect const& angle_friction_effect();

}  // namespace torquescope
