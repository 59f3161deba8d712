#pragma once
// What a servo is, in numbers, and what is screwed to it. Nothing of the engine.
//
// Units      SI: rad, s, V, N m, kg, m
// Without    an effect's number at its default is no such effect

#include <limits>

namespace servo {

constexpr double step_s = 1e-4;     // of the integration
constexpr int steps_per_tick = 10;  // of the controller in the drive: 1 kHz
constexpr double log_period_s = 0.01;
constexpr int encoder_counts = 4096;  // a turn
constexpr double gravity_m_s2 = 9.80665;
constexpr double gain_per_kp = 0.165;   // command_gain = 0.165 kp supply
constexpr double greatest_duty = 0.97;  // command_limit = 0.97 supply
constexpr double no_limit = std::numeric_limits<double>::infinity();

struct ServoNumbers {
  // of the joint
  double inertia = 0.025, viscous = 0.05, coulomb = 0.10;
  double load_friction = 0.0;      // 1
  double load_square = 0.0;        // 1/(N m)
  double stribeck_friction = 0.0;  // N m
  double load_stribeck = 0.0;      // 1
  double stribeck_speed = 0.2;
  double angle_friction = 0.0;  // N m, by the sine of the angle
  double arm_mass = 0.0;        // of a rod from the axis to the load
  // of the drive
  double motor_gain = 0.2, back_emf = 0.15;  // N m/V, N m s/rad
  double command_delay_s = 0.0, goal_speed_limit = no_limit, goal_acceleration_limit = no_limit;
  double dead_band = 0.0, punch = 0.0;  // rad, V
  double torque_lag_s = 0.0;
};

struct Setting {
  double mass_kg = 0.0, length_m = 0.0, kp = 32.0, supply_v = 12.0;
  double command_gain() const { return gain_per_kp * kp * supply_v; }
  double command_limit() const { return greatest_duty * supply_v; }
};

}  // namespace servo
