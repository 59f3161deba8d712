#include "engine/simulate/rollout/loop_form.hpp"

#include <array>
#include <utility>

namespace torquescope {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr double largest = 1e9;

constexpr std::array<std::pair<LoopForm, char const*>, 8> forms{{{LoopForm::identified, "identified"},
                                                                 {LoopForm::p, "p"},
                                                                 {LoopForm::pi, "pi"},
                                                                 {LoopForm::pd, "pd"},
                                                                 {LoopForm::pid, "pid"},
                                                                 {LoopForm::p_velocity, "p_velocity"},
                                                                 {LoopForm::p_pi, "p_pi"},
                                                                 {LoopForm::none, "none"}}};

using enum LoopMeasure;
constexpr std::array<LoopKeyFacts, loop_keys> facts{{
    {LoopKey::kp, "kp", "", "", number, 0.0, 0.0, largest},
    {LoopKey::ki, "ki", "", "", number, 0.0, 0.0, largest},
    {LoopKey::kd, "kd", "N m s/rad", "N s/m", number, 0.0, 0.0, largest},
    {LoopKey::kv, "kv", "N m s/rad", "N s/m", number, 0.0, 0.0, largest},
    {LoopKey::feed_speed, "feed_speed", "1", "1", number, 0.0, -2.0, 2.0},
    {LoopKey::feed_acceleration, "feed_acceleration", "kg m2", "kg", number, 0.0, -largest, largest},
    {LoopKey::added_command_gain, "added_command_gain", "N m per unit", "N per unit", number, 1.0, -largest, largest},
    {LoopKey::torque_limit, "torque_limit", "N m", "N", number, no_limit, 0.0, largest},
    {LoopKey::speed_lag_s, "speed_lag_s", "s", "s", time, 0.0, 0.0, 1.0},
    {LoopKey::back_emf, "back_emf", "N m s/rad", "N s/m", torque_per_speed, 0.0, 0.0, largest},
    {LoopKey::goal_speed_limit, "goal_speed_limit", "rad/s", "m/s", speed, no_limit, 1e-6, largest},
    {LoopKey::goal_acceleration_limit, "goal_acceleration_limit", "rad/s2", "m/s2", acceleration, no_limit, 1e-6,
     largest},
    {LoopKey::command_delay_s, "command_delay_s", "s", "s", time, 0.0, 0.0, 0.25},
    {LoopKey::torque_delay_s, "torque_delay_s", "s", "s", time, 0.0, 0.0, 0.25},
    {LoopKey::torque_lag_s, "torque_lag_s", "s", "s", time, 0.0, 0.0, 1.0},
    {LoopKey::torque_log_lag_s, "torque_log_lag_s", "s", "s", time, 0.0, 0.0, 1.0},
    {LoopKey::motor_gain, "motor_gain", "N m per unit", "N per unit", number, 1.0, 0.0, largest},
    {LoopKey::dead_band, "dead_band", "rad", "m", position, 0.0, 0.0, largest},
    {LoopKey::punch, "punch", "unit of the command", "unit of the command", torque, 0.0, 0.0, largest},
    {LoopKey::load_friction, "load_friction", "1", "1", number, 0.0, 0.0, 1.0},
    {LoopKey::load_square_friction, "load_square_friction", "1/(N m)", "1/N", per_torque, 0.0, 0.0, largest},
    {LoopKey::stribeck_friction, "stribeck_friction", "N m", "N", torque, 0.0, 0.0, largest},
    {LoopKey::stribeck_speed, "stribeck_speed", "rad/s", "m/s", speed, 0.1, 1e-6, largest},
    {LoopKey::load_stribeck_friction, "load_stribeck_friction", "1", "1", number, 0.0, 0.0, 1.0},
    {LoopKey::arm_mass, "arm_mass", "kg", "kg", mass, 0.0, 0.0, largest},
    {LoopKey::motor_gain_per_kelvin, "motor_gain_per_kelvin", "1/K", "1/K", number, 0.0, -0.05, 0.05},
    {LoopKey::load_motor_share, "load_motor_share", "1", "1", number, 0.5, -1.0, 2.0},
    {LoopKey::angle_friction_cos, "angle_friction_cos", "N m", "N", torque, 0.0, -largest, largest},
    {LoopKey::angle_friction_sin, "angle_friction_sin", "N m", "N", torque, 0.0, -largest, largest},
}};

}  // namespace

std::string word(LoopForm form) {
  for (auto const& [one, name] : forms)
    if (one == form) return name;
  return {};
}

std::optional<LoopForm> loop_form_of(std::string const& word) {
  for (auto const& [form, name] : forms)
    if (word == name) return form;
  return {};
}

std::vector<std::string> loop_form_words() {
  std::vector<std::string> words;
  for (auto const& one : forms) words.emplace_back(one.second);
  return words;
}

LoopKeyFacts const& facts_of(LoopKey key) { return facts[static_cast<std::size_t>(key)]; }

std::optional<LoopKey> loop_key_of(std::string const& name) {
  for (auto const& one : facts)
    if (name == one.name) return one.key;
  return {};
}

std::vector<LoopKey> gains_of(LoopForm form) {
  using enum LoopKey;
  switch (form) {
    case LoopForm::p:
      return {kp};
    case LoopForm::pi:
      return {kp, ki};
    case LoopForm::pd:
      return {kp, kd};
    case LoopForm::pid:
      return {kp, ki, kd};
    case LoopForm::p_velocity:
      return {kp, kv};
    case LoopForm::p_pi:
      return {kp, kv, ki};
    case LoopForm::identified:
    case LoopForm::none:
      break;
  }
  return {};
}

LoopValues::LoopValues() : value{} {
  for (auto const& one : facts) (*this)[one.key] = one.none;
}

LoopNumbers numbers_of(LoopForm form, LoopValues const& values) {
  using enum LoopKey;
  LoopNumbers numbers;
  bool const is_cascade = form == LoopForm::p_velocity || form == LoopForm::p_pi;
  if (is_cascade) {
    numbers.kp = values[kv] * values[kp];
    numbers.kd = values[kv];
    numbers.ki = form == LoopForm::p_pi ? values[ki] * values[kp] : 0.0;
    numbers.ki_speed = form == LoopForm::p_pi ? values[ki] : 0.0;
  } else if (form != LoopForm::none && form != LoopForm::identified) {
    numbers.kp = values[kp];
    numbers.kd = form == LoopForm::pd || form == LoopForm::pid ? values[kd] : 0.0;
    numbers.ki = form == LoopForm::pi || form == LoopForm::pid ? values[ki] : 0.0;
  }
  numbers.feed_speed = values[feed_speed];
  numbers.feed_acceleration = values[feed_acceleration];
  numbers.added_gain = values[added_command_gain];
  numbers.least = -values[torque_limit];
  numbers.most = values[torque_limit];
  numbers.speed_lag_s = values[speed_lag_s];
  numbers.back_emf = values[back_emf];
  numbers.goal_speed = values[goal_speed_limit];
  numbers.goal_acceleration = values[goal_acceleration_limit];
  numbers.command_delay_s = values[command_delay_s];
  numbers.torque_delay_s = values[torque_delay_s];
  numbers.torque_lag_s = values[torque_lag_s];
  numbers.log_lag_s = values[torque_log_lag_s];
  numbers.motor_gain = values[motor_gain];
  numbers.dead_band = values[dead_band];
  numbers.punch = values[punch];
  return numbers;
}

GearFriction gear_of(LoopValues const& values) {
  using enum LoopKey;
  return {values[load_friction],          values[load_square_friction], values[stribeck_friction],
          values[load_stribeck_friction], values[stribeck_speed],       values[load_motor_share],
          values[angle_friction_cos],     values[angle_friction_sin]};
}

}  // namespace torquescope
