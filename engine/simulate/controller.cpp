#include "engine/simulate/controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/contract.hpp"
#include "engine/base/portable_math.hpp"

namespace torquescope {

namespace {

struct NamedGain {
  char const* key;
  double value;
  bool belongs;  // to the kind in use
};

std::vector<NamedGain> named_gains(ControllerOptions const& options) {
  bool const cascade = options.kind == "p_velocity";
  return {{"kp", options.kp, true},
          {"kv", options.kv, cascade},
          {"kd", options.kd, !cascade},
          {"ki", options.ki, options.kind == "pid"}};
}

bool has_gains(ControllerOptions const& options) {
  for (auto const& gain : named_gains(options))
    if (gain.value != 0.0) return true;
  return false;
}

}  // namespace

OptionTable<ControllerOptions> const& ControllerOptions::table() {
  constexpr double unlimited = std::numeric_limits<double>::max();
  using O = ControllerOptions;
  static OptionTable<ControllerOptions> const options(
      "simulate.controller", "the discrete controller that moves the simulated joint",
      {{"kind",
        &O::kind,
        {"p_velocity", "pd", "pid"},
        "p_velocity: position gain round a velocity loop; pd, pid: gains on position and velocity error"},
       {"rate_hz", &O::rate_hz, "Hz", 0.0, 1e6,
        "ticks per second, a multiple of the recording's rate; 0: its lowest multiple from 1000 Hz on"},
       {"bandwidth_hz", &O::bandwidth_hz, "Hz", 1e-3, 1e5,
        "sets all gains from the plant's inertia, unless gains are given"},
       {"kp", &O::kp, "N m/rad or N/m; p_velocity: 1/s", 0.0, unlimited, "position gain"},
       {"kv", &O::kv, "N m s/rad or N s/m", 0.0, unlimited, "p_velocity: gain of the velocity loop"},
       {"kd", &O::kd, "N m s/rad or N s/m", 0.0, unlimited, "pd, pid: gain of the velocity error"},
       {"ki", &O::ki, "N m/(rad s) or N/(m s)", 0.0, unlimited, "pid: gain of the integral"},
       {"torque_limit", &O::torque_limit, "N m or N", 0.0, unlimited, "largest torque of the motor; 0: none"},
       {"velocity_cutoff_hz", &O::velocity_cutoff_hz, "Hz", 0.0, unlimited,
        "first-order low-pass of the differentiated position; 0: none"},
       {"feedforward", &O::feedforward, "adds what the motion needs by itself: J ddq_ref, and kv dq_ref in p_velocity"},
       {"delay_ticks", &O::delay_ticks, "1", 0.0, 100.0, "ticks between reading the encoder and acting"},
       {"torque_log",
        &O::torque_log,
        {"applied", "averaged"},
        "what stands in the torque column: applied: held from the sample on, as drives log it, half a tick ahead of "
        "the "
        "motion; averaged: mean of the torque before and after the sample"}});
  return options;
}

double controller_rate_hz(ControllerOptions const& options, double recording_rate_hz) {
  if (options.rate_hz > 0.0) return options.rate_hz;
  return recording_rate_hz * std::max(1.0, std::ceil(1000.0 / recording_rate_hz));
}

void check_controller(ControllerOptions const& options, double recording_rate_hz, Section const& section,
                      std::vector<Problem>& problems) {
  // one sample of the recording is a whole number of ticks
  double const rate_hz = controller_rate_hz(options, recording_rate_hz);
  double const ratio = rate_hz / recording_rate_hz;
  if (ratio < 0.5 || std::abs(ratio - std::round(ratio)) > 1e-9 * ratio)
    problems.push_back(
        problem_at(section, "rate_hz",
                   fmt::format("rate_hz = {} is not a multiple of the recording's {} Hz", rate_hz, recording_rate_hz),
                   fmt::format("write rate_hz = {}", recording_rate_hz * std::max(1.0, std::round(ratio)))));

  // gains: all that the kind needs and no others
  std::string needed;
  bool complete = true;
  for (auto const& gain : named_gains(options)) {
    if (gain.belongs) {
      needed += fmt::format("{}{}", needed.empty() ? "" : ", ", gain.key);
      complete = complete && gain.value > 0.0;
    } else if (gain.value != 0.0) {
      problems.push_back(problem_at(section, gain.key,
                                    fmt::format("{} has no effect in kind = \"{}\"", gain.key, options.kind),
                                    "remove it, or choose the kind that has it"));
    }
  }
  if (has_gains(options) && !complete)
    problems.push_back(problem_at(section, "kp", fmt::format("kind = \"{}\" needs all of its gains", options.kind),
                                  fmt::format("give {}, or none of them and bandwidth_hz", needed)));
  if (has_gains(options) && section.find("bandwidth_hz"))
    problems.push_back(problem_at(section, "bandwidth_hz", "bandwidth_hz and gains are both given",
                                  "remove one of them: bandwidth_hz would set the gains"));

  if (!has_gains(options) && options.bandwidth_hz > 0.05 * rate_hz)
    problems.push_back(
        problem_at(section, "bandwidth_hz",
                   fmt::format("bandwidth_hz = {} is too fast for {} ticks a second", options.bandwidth_hz, rate_hz),
                   fmt::format("stay below {} Hz, or raise rate_hz", 0.05 * rate_hz)));
  if (options.velocity_cutoff_hz >= 0.5 * rate_hz)
    problems.push_back(problem_at(
        section, "velocity_cutoff_hz",
        fmt::format("velocity_cutoff_hz = {} is not below half of {} Hz", options.velocity_cutoff_hz, rate_hz),
        "lower it, or write velocity_cutoff_hz = 0 for none"));
}

ControllerGains controller_gains(ControllerOptions const& options, double inertia) {
  if (has_gains(options)) return {options.kp, options.kv, options.kd, options.ki};
  double const omega = 2.0 * std::numbers::pi * options.bandwidth_hz;
  if (options.kind == "p_velocity") return {0.5 * omega, 2.0 * inertia * omega, 0.0, 0.0};
  if (options.kind == "pd") return {inertia * omega * omega, 0.0, 2.0 * inertia * omega, 0.0};
  return {3.0 * inertia * omega * omega, 0.0, 3.0 * inertia * omega, inertia * omega * omega * omega};
}

Controller::Controller(ControllerOptions const& options, double rate_hz, double inertia, ReferencePoint const& start)
    : options_(options),
      period_s_(1.0 / rate_hz),
      inertia_(inertia),
      gains_(controller_gains(options, inertia)),
      velocity_share_(options.velocity_cutoff_hz > 0.0
                          ? 1.0 - portable_exp(-2.0 * std::numbers::pi * options.velocity_cutoff_hz / rate_hz)
                          : 1.0),
      velocity_(start.dq),
      delayed_(static_cast<std::size_t>(options.delay_ticks), 0.0) {
  TORQUESCOPE_EXPECT(rate_hz > 0.0 && inertia > 0.0);
}

double Controller::measured_velocity(double position) {
  // the first tick has no difference: the joint starts on its reference
  if (has_last_position_) velocity_ += velocity_share_ * ((position - last_position_) / period_s_ - velocity_);
  last_position_ = position;
  has_last_position_ = true;
  return velocity_;
}

double Controller::limited(double torque) const {
  if (options_.torque_limit == 0.0) return torque;
  return std::clamp(torque, -options_.torque_limit, options_.torque_limit);
}

double Controller::answer(ReferencePoint const& reference, double position, double velocity, double model_torque) {
  double const error = reference.q - position;
  double const ahead = options_.feedforward ? model_torque : 0.0;
  if (options_.kind == "p_velocity") {
    double const wanted_velocity = gains_.kp * error + (options_.feedforward ? reference.dq : 0.0);
    return limited(gains_.kv * (wanted_velocity - velocity) + ahead);
  }

  double const proportional = gains_.kp * error + gains_.kd * (reference.dq - velocity) + ahead;
  double const integral = integral_ + error * period_s_;
  double const wanted = proportional + gains_.ki * integral;
  double const torque = limited(wanted);
  // beyond the limit the integral may only come back
  if (torque == wanted || (wanted - torque) * error < 0.0) integral_ = integral;
  return torque;
}

double Controller::command(ReferencePoint const& reference, double measured_position) {
  return command(reference, measured_position, inertia_ * reference.ddq);
}

double Controller::command(ReferencePoint const& reference, double measured_position, double model_torque) {
  double const velocity = measured_velocity(measured_position);
  delayed_.push_back(answer(reference, measured_position, velocity, model_torque));
  double const torque = delayed_.front();
  delayed_.pop_front();
  return torque;
}

}  // namespace torquescope
