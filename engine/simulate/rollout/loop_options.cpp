#include "engine/simulate/rollout/loop_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/simulate/rollout/loop_lanes.hpp"

namespace torquescope {
namespace {

using Member = double LoopOptions::*;
constexpr std::array<Member, loop_keys> members{&LoopOptions::kp,
                                                &LoopOptions::ki,
                                                &LoopOptions::kd,
                                                &LoopOptions::kv,
                                                &LoopOptions::feed_speed,
                                                &LoopOptions::feed_acceleration,
                                                &LoopOptions::added_command_gain,
                                                &LoopOptions::torque_limit,
                                                &LoopOptions::speed_lag_s,
                                                &LoopOptions::back_emf,
                                                &LoopOptions::goal_speed_limit,
                                                &LoopOptions::goal_acceleration_limit,
                                                &LoopOptions::command_delay_s,
                                                &LoopOptions::torque_delay_s,
                                                &LoopOptions::torque_lag_s,
                                                &LoopOptions::torque_log_lag_s,
                                                &LoopOptions::motor_gain,
                                                &LoopOptions::dead_band,
                                                &LoopOptions::punch,
                                                &LoopOptions::load_friction,
                                                &LoopOptions::load_square_friction,
                                                &LoopOptions::stribeck_friction,
                                                &LoopOptions::stribeck_speed,
                                                &LoopOptions::load_stribeck_friction,
                                                &LoopOptions::arm_mass,
                                                &LoopOptions::motor_gain_per_kelvin,
                                                &LoopOptions::load_motor_share,
                                                &LoopOptions::angle_friction_cos,
                                                &LoopOptions::angle_friction_sin};

double given(LoopOptions const& options, LoopKey key) { return options.*members[static_cast<std::size_t>(key)]; }

bool is_gain(LoopKey key) {
  using enum LoopKey;
  return key == kp || key == ki || key == kd || key == kv;
}

template <class Check>
void for_each_key(Check&& check) {
  for (std::size_t k = 0; k < loop_keys; ++k) check(static_cast<LoopKey>(k));
}

}  // namespace

OptionTable<LoopOptions> const& LoopOptions::table() {
  using Options = LoopOptions;
  static OptionTable<Options> const table(
      "loop", "the controller that led the recordings, for rollouts",
      {{"controller", &Options::controller, loop_form_words(),
        "identified: a linear controller found in the recording; p_velocity: kv (kp e - dq); p_pi: kv s + ki (integral "
        "of s) "
        "with s = kp e - dq; none: the recorded torque drives the joint"},
       {"drive", &Options::drive,
        "what the command of a servo is, in a job with [[recordings]]: voltage (with back-EMF), current, or position "
        "servo (the error of the position itself); voltage where known.command_gain is given"},
       {"rate_hz", &Options::rate_hz, "Hz", 0.0, 1e6,
        "of the controller; 0: that of the recording. Above it the reference changes between answers"},
       {"reference", &Options::reference, std::vector<std::string>{"held", "straight"},
        "between two samples: held, as a bus sends it, or straight"},
       {"speed", &Options::speed, std::vector<std::string>{"difference", "joint"},
        "that the controller sees: the backward difference of the position, or the joint's own, as of a tachometer or "
        "a drive that samples faster"},
       {"speed_samples", &Options::speed_samples, "1", 0, static_cast<double>(most_speed_samples),
        "that the difference spans; 0: those with which the controller answers most as the recorded torque does"},
       {"fit", &Options::fit,
        "keys of this section that a fit searches, beginning at what is written; gains that are left out always are"},
       {"channels", &Options::channels,
        "that count: position, torque. A torque that was computed from the position is no second channel"},
       {"window_s", &Options::window_s, "s", 0.0, 1e6,
        "of recordings without a reference: rollouts begin anew at the measured state so often; 0: never"},
       {"kp", &Options::kp, "N m/rad; of a cascade 1/s", 0.0, 1e9, "position gain"},
       {"ki", &Options::ki, "N m/(rad s); of a cascade N m/rad", 0.0, 1e9, "integral gain"},
       {"kd", &Options::kd, "N m s/rad", 0.0, 1e9, "of the speed, pd and pid"},
       {"kv", &Options::kv, "N m s/rad", 0.0, 1e9, "speed gain of p_velocity and p_pi"},
       {"feed_speed", &Options::feed_speed, "1", -10.0, 10.0, "share of the reference's speed that is fed forward"},
       {"feed_acceleration", &Options::feed_acceleration, "kg m2; kg", -1e9, 1e9,
        "torque per acceleration of the reference"},
       {"added_command_gain", &Options::added_command_gain, "N m per unit", -1e9, 1e9,
        "torque per unit of the column added_command; 1"},
       {"torque_limit", &Options::torque_limit, "N m; N", 0.0, 1e9, "of the command"},
       {"speed_lag_s", &Options::speed_lag_s, "s", 0.0, 1.0, "low-pass of the speed that the controller sees"},
       {"back_emf", &Options::back_emf, "N m s/rad", 0.0, 1e9,
        "torque lost per speed while the drive is on: of a motor voltage as command"},
       {"goal_speed_limit", &Options::goal_speed_limit, "rad/s; m/s", 1e-9, 1e9, "of the drive's profile generator"},
       {"goal_acceleration_limit", &Options::goal_acceleration_limit, "rad/s2; m/s2", 1e-9, 1e12, "the same"},
       {"command_delay_s", &Options::command_delay_s, "s", 0.0, 0.25, "until the controller sees the reference"},
       {"torque_delay_s", &Options::torque_delay_s, "s", 0.0, 0.25, "until the motor gives what was commanded"},
       {"torque_lag_s", &Options::torque_lag_s, "s", 0.0, 1.0, "first-order lag of the motor's torque"},
       {"torque_log_lag_s", &Options::torque_log_lag_s, "s", 0.0, 1.0, "low-pass of the torque as it was logged"},
       {"motor_gain", &Options::motor_gain, "N m per unit", 0.0, 1e9, "torque per unit of the drive's command; 1"},
       {"dead_band", &Options::dead_band, "rad; m", 0.0, 1e9, "error that the drive takes for none"},
       {"punch", &Options::punch, "unit of the command", 0.0, 1e9, "least command of an error that is not none"},
       {"load_friction", &Options::load_friction, "1", 0.0, 1.0, "dry friction per torque on the gear"},
       {"load_square_friction", &Options::load_square_friction, "1/(N m)", 0.0, 1e9,
        "the same by the square of that torque"},
       {"stribeck_friction", &Options::stribeck_friction, "N m", 0.0, 1e9, "dry friction that goes with speed"},
       {"stribeck_speed", &Options::stribeck_speed, "rad/s", 1e-6, 1e9, "at which a third of it is left; 0.1"},
       {"load_stribeck_friction", &Options::load_stribeck_friction, "1", 0.0, 1.0, "the same per torque on the gear"},
       {"arm_mass", &Options::arm_mass, "kg", 0.0, 1e6, "of a bar of known.arm_length that carries the load"},
       {"motor_gain_per_kelvin", &Options::motor_gain_per_kelvin, "1/K", -1.0, 1.0,
        "of motor_gain, from 25 deg C on, over known.temperature"},
       {"load_motor_share", &Options::load_motor_share, "1", -1.0, 2.0,
        "share of the motor's torque in what loads the gear, the rest is the weight's; 0.5"},
       {"angle_friction_cos", &Options::angle_friction_cos, "N m", -1e9, 1e9, "dry friction by cos(position)"},
       {"angle_friction_sin", &Options::angle_friction_sin, "N m", -1e9, 1e9, "dry friction by sin(position)"}});
  return table;
}

LoopForm form_of(LoopOptions const& options) { return loop_form_of(options.controller).value_or(LoopForm::identified); }

std::vector<LoopKey> missing_gains(LoopOptions const& options) {
  std::vector<LoopKey> missing;
  for (LoopKey const key : gains_of(form_of(options)))
    if (std::isnan(given(options, key))) missing.push_back(key);
  return missing;
}

void check_loop(LoopOptions const& options, Section const& section, std::vector<Problem>& problems) {
  LoopForm const form = form_of(options);
  auto const gains = gains_of(form);
  for_each_key([&](LoopKey key) {
    bool const belongs = !is_gain(key) || std::find(gains.begin(), gains.end(), key) != gains.end();
    if (belongs || std::isnan(given(options, key))) return;
    problems.push_back(problem_at(section, facts_of(key).name,
                                  fmt::format("{} is no gain of controller = \"{}\"", facts_of(key).name, word(form)),
                                  "remove it, or name the controller that has it: p, pi, pd, pid, p_velocity, p_pi"));
  });
  for (auto const& name : options.fit) {
    auto const key = loop_key_of(name);
    if (!key) {
      problems.push_back(problem_at(section, "fit", fmt::format("fit: nothing of a loop is called \"{}\"", name),
                                    "write keys of [loop] (torquescope describe loop)"));
      continue;
    }
    if (is_gain(*key) && std::find(gains.begin(), gains.end(), *key) == gains.end()) {
      problems.push_back(problem_at(section, "fit",
                                    fmt::format("fit: {} is no gain of controller = \"{}\"", name, word(form)),
                                    "remove it, or name the controller that has it: p, pi, pd, pid, p_velocity, p_pi"));
      continue;
    }
    bool const has_no_start = std::isnan(given(options, *key)) && !std::isfinite(facts_of(*key).none);
    if (has_no_start)
      problems.push_back(problem_at(section, "fit", fmt::format("fit: {} has no value to begin at", name),
                                    fmt::format("write {} = ... as well", name)));
    if (form == LoopForm::identified && (*key == LoopKey::command_delay_s || *key == LoopKey::goal_speed_limit ||
                                         *key == LoopKey::goal_acceleration_limit))
      problems.push_back(problem_at(section, "fit",
                                    fmt::format("fit: an identified controller has no {} of its own", name),
                                    "name the controller: p, pi, pd, pid, p_velocity, p_pi"));
  }
  for (auto const& channel : options.channels)
    if (channel != "position" && channel != "torque")
      problems.push_back(problem_at(section, "channels", fmt::format("channels: \"{}\" is none", channel),
                                    "position, torque, or both"));
  if (options.channels.empty())
    problems.push_back(problem_at(section, "channels", "channels: none counts", "position, torque, or both"));
}

TrackOptions track_options(LoopOptions const& options) {
  return {options.rate_hz, options.reference == "straight", options.window_s};
}

CountedChannels channels_of(LoopOptions const& options) {
  auto const has = [&](char const* name) {
    return std::find(options.channels.begin(), options.channels.end(), name) != options.channels.end();
  };
  return {has("position"), has("torque")};
}

LoopSetting loop_setting(LoopOptions const& options, double recording_rate_hz) {
  LoopSetting setting;
  setting.form = form_of(options);
  setting.speed_samples =
      options.speed == "joint" ? 0 : static_cast<std::size_t>(std::max<std::int64_t>(1, options.speed_samples));
  for_each_key([&](LoopKey key) {
    if (!std::isnan(given(options, key))) setting.values[key] = given(options, key);
  });
  setting.free = missing_gains(options);
  for (auto const& name : options.fit) {
    auto const key = loop_key_of(name);
    if (key && std::find(setting.free.begin(), setting.free.end(), *key) == setting.free.end())
      setting.free.push_back(*key);
  }
  if (options.rate_hz > 0.0 && options.rate_hz < recording_rate_hz)
    setting.hold_ticks = static_cast<std::size_t>(std::max(1.0, std::round(recording_rate_hz / options.rate_hz)));
  return setting;
}

}  // namespace torquescope
