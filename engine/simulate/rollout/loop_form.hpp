#pragma once
// The controllers that a job may name, and how their gains come down to the numbers of a loop (loop_numbers.hpp).
//
// Forms      identified: a linear controller found in the recording (simulate/controller_fit.hpp); p: kp e; pi; pd;
//            pid; p_velocity: kv (kp e - v); p_pi: kv s + ki (integral of s), s = kp e - v, the cascade of drives;
//            none: there is no controller, the recorded torque drives the joint
// Gains      p_velocity, p_pi: kp 1/s, kv N m s/rad, ki N m/rad; the others N m/rad, N m/(rad s), N m s/rad
// Threads    plain records, free functions
// Source     cascade: Ellis 2012, Control System Design Guide, chapter 17, ISBN 978-0-12-385920-4

#include <optional>
#include <string>
#include <vector>

#include "engine/simulate/rollout/gear_friction.hpp"
#include "engine/simulate/rollout/loop_numbers.hpp"

namespace torquescope {

enum class LoopForm { identified, p, pi, pd, pid, p_velocity, p_pi, none };
std::string word(LoopForm form);
std::optional<LoopForm> loop_form_of(std::string const& word);
std::vector<std::string> loop_form_words();

// one number of a loop and its gear as people write it
enum class LoopKey {
  kp,
  ki,
  kd,
  kv,
  feed_speed,
  feed_acceleration,
  added_command_gain,
  torque_limit,
  speed_lag_s,
  back_emf,
  goal_speed_limit,
  goal_acceleration_limit,
  command_delay_s,
  torque_delay_s,
  torque_lag_s,
  torque_log_lag_s,
  motor_gain,
  dead_band,
  punch,
  load_friction,
  load_square_friction,
  stribeck_friction,
  stribeck_speed,
  load_stribeck_friction,
  arm_mass,
  motor_gain_per_kelvin,
  load_motor_share,
  angle_friction_cos,
  angle_friction_sin
};
inline constexpr std::size_t loop_keys = 29;

// what a number is measured in: its natural size follows from those of the joint
enum class LoopMeasure { number, time, torque, torque_per_speed, speed, acceleration, position, mass, per_torque };

struct LoopKeyFacts {
  LoopKey key;
  char const* name;
  char const* unit_revolute;
  char const* unit_prismatic;
  LoopMeasure measure;
  double none;         // its value where nothing is written and nothing fitted
  double least, most;  // plausible, for a fit
};
LoopKeyFacts const& facts_of(LoopKey key);
std::optional<LoopKey> loop_key_of(std::string const& name);

// what the form cannot do without
std::vector<LoopKey> gains_of(LoopForm form);

// one number of each key
struct LoopValues {
  double value[loop_keys];
  LoopValues();  // none of each
  double& operator[](LoopKey key) { return value[static_cast<std::size_t>(key)]; }
  double operator[](LoopKey key) const { return value[static_cast<std::size_t>(key)]; }
};

LoopNumbers numbers_of(LoopForm form, LoopValues const& values);
GearFriction gear_of(LoopValues const& values);

}  // namespace torquescope
