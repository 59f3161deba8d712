#pragma once
// A servo's numbers, drawn: what every servo has, and the effects that a set is told to have.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "servo/servo_numbers.hpp"

namespace servo {

struct Law {
  char const* name;
  double low, high, without;  // range that its number is drawn from, and the number that is no such effect
  double ServoNumbers::*number;
};

inline constexpr std::array<Law, 12> laws{{
    {"command_delay", 0.020, 0.040, 0.0, &ServoNumbers::command_delay_s},
    {"goal_speed_limit", 3.0, 6.0, no_limit, &ServoNumbers::goal_speed_limit},
    {"goal_acceleration_limit", 20.0, 60.0, no_limit, &ServoNumbers::goal_acceleration_limit},
    {"load_friction", 0.1, 0.4, 0.0, &ServoNumbers::load_friction},
    {"load_square", 0.05, 0.2, 0.0, &ServoNumbers::load_square},
    {"stribeck", 0.05, 0.15, 0.0, &ServoNumbers::stribeck_friction},
    {"load_stribeck", 0.1, 0.3, 0.0, &ServoNumbers::load_stribeck},
    {"dead_band", 0.02, 0.05, 0.0, &ServoNumbers::dead_band},
    {"punch", 0.8, 1.8, 0.0, &ServoNumbers::punch},
    {"torque_lag", 0.004, 0.012, 0.0, &ServoNumbers::torque_lag_s},
    {"arm_mass", 0.05, 0.15, 0.0, &ServoNumbers::arm_mass},
    {"angle_friction", 0.03, 0.06, 0.0, &ServoNumbers::angle_friction},
}};

Law const& law_named(std::string const& name);

// heaviest: a servo that cannot lift it slowly to the horizontal is drawn anew
ServoNumbers draw_servo(std::uint64_t seed, std::vector<std::string> const& with, Setting const& heaviest);
bool lifts(ServoNumbers const& servo, Setting const& setting);

}  // namespace servo
