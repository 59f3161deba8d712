#pragma once
// A position-controlled servo by itself, as its data sheet and its gear's controller say it: what lanes of servos are
// held against. No code of the engine.
//
// Tick       the drive reads the position, answers, and its command is held until the next answer
// Motion     `finer` steps a tick, implicit in the damping, the weight in the middle of the step; dry friction is a
//            set: a step whose velocity meets zero ends there, at rest, and friction is asked anew
// Friction   coulomb + (load + load_square l) l + (stribeck + load_stribeck l) (1 + (v / stribeck_speed)^2 / 16)^-16,
//            l = |motor + weight| / 2; as it was at the tick, or at every step of its own
// Units      SI; the command in V

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "unit/rollout/plain_loop.hpp"

namespace torquescope::test {

struct PlainServo {
  double inertia = 0.045, viscous = 0.05, coulomb = 0.12, offset = 0.0, weight = 0.0;  // weight: N m of sin q
  double load = 0.0, load_square = 0.0, stribeck = 0.0, load_stribeck = 0.0, stribeck_speed = 0.3;
  double angle_cos = 0.0, angle_sin = 0.0;
  double gain = 60.0, limit = std::numeric_limits<double>::infinity();  // V per rad, V
  double dead_band = 0.0, punch = 0.0, command_delay_s = 0.0;
  double motor_gain = 0.25, back_emf = 0.16, encoder_step = 0.0;
  int hold = 1;                  // ticks from answer to answer
  bool rubs_every_step = false;  // friction of the gear follows within a tick
};

struct ServoMotion {
  std::vector<double> position, velocity, command;
};

class PlainServoRun {
 public:
  PlainServoRun(PlainServo const& servo, PlainInputs const& inputs, PlainStart const& start, int finer)
      : s_(servo), in_(inputs), finer_(finer), q_(start.position), v_(start.velocity) {
    tick_s_ = 1.0 / (in_.rate_hz * in_.ticks_per_sample);
  }

  ServoMotion run() {
    ServoMotion motion;
    int const ticks = static_cast<int>(in_.reference.size()) * in_.ticks_per_sample;
    double command = 0.0;
    for (int tick = 0; tick < ticks; ++tick) {
      int const sample = tick / in_.ticks_per_sample;
      double const on = in_.enabled.empty() ? 1.0 : in_.enabled[static_cast<std::size_t>(sample)];
      double const read = s_.encoder_step > 0.0 ? s_.encoder_step * std::round(q_ / s_.encoder_step) : q_;
      if (tick % s_.hold == 0) command = answer(goal_at(tick) - read);
      if (tick % in_.ticks_per_sample == 0) {
        motion.position.push_back(read);
        motion.velocity.push_back(v_);
        motion.command.push_back(on * command);
      }
      move(on * command * s_.motor_gain, on * s_.back_emf);
    }
    return motion;
  }

 private:
  double at_tick(int tick) const {
    int const last = static_cast<int>(in_.reference.size()) * in_.ticks_per_sample - 1;
    int const within = std::min(std::max(tick, 0), last), sample = within / in_.ticks_per_sample;
    auto const at = static_cast<std::size_t>(sample);
    if (!in_.straight || at + 1 >= in_.reference.size()) return in_.reference[at];
    double const share = static_cast<double>(within % in_.ticks_per_sample) / in_.ticks_per_sample;
    return (1.0 - share) * in_.reference[at] + share * in_.reference[at + 1];
  }

  // late by the delay; between two ticks a straight line
  double goal_at(int tick) const {
    double const seen = tick - s_.command_delay_s / tick_s_;
    int const before = static_cast<int>(std::floor(seen));
    double const share = seen - before;
    return (1.0 - share) * at_tick(before) + share * at_tick(before + 1);
  }

  double answer(double error) const {
    if (std::abs(error) <= s_.dead_band) return 0.0;
    double const size = std::min(std::max(s_.gain * std::abs(error), s_.punch), s_.limit);
    return error < 0.0 ? -size : error > 0.0 ? size : 0.0;
  }

  double friction(double motor, double brake) const {
    double const l = 0.5 * std::abs(motor - brake * v_ + s_.weight * std::sin(q_));
    double const x = v_ / s_.stribeck_speed;
    double const bell = std::pow(1.0 + x * x / 16.0, -16.0);
    double const of_angle = s_.angle_cos * std::cos(q_) + s_.angle_sin * std::sin(q_);
    return s_.coulomb + (s_.load + s_.load_square * l) * l + (s_.stribeck + s_.load_stribeck * l) * bell + of_angle;
  }

  void move(double motor, double brake) {
    double const h = tick_s_ / finer_;
    double dry = friction(motor, brake);
    for (int step = 0; step < finer_; ++step) {
      if (s_.rubs_every_step) dry = friction(motor, brake);
      slide(motor - s_.offset, dry, s_.viscous + brake, h);
    }
  }

  void slide(double acts, double dry, double damping, double h) {
    for (int part = 0; part < 3 && h > 0.0; ++part) {
      double const pull = acts - s_.weight * std::sin(q_ + 0.5 * h * v_);
      double way = v_ > 0.0 ? 1.0 : v_ < 0.0 ? -1.0 : 0.0;
      if (way == 0.0) way = pull > dry ? 1.0 : pull < -dry ? -1.0 : 0.0;
      if (way == 0.0) return;
      double const half = 0.5 * h * damping / s_.inertia;
      double const next = (v_ * (1.0 - half) + h * (pull - way * dry) / s_.inertia) / (1.0 + half);
      double const slides = next * way >= 0.0 ? h : h * v_ / (v_ - next);
      double const end = next * way >= 0.0 ? next : 0.0;
      q_ += 0.5 * slides * (v_ + end);
      v_ = end;
      h -= slides;
    }
  }

  PlainServo s_;
  PlainInputs in_;
  int finer_;
  double tick_s_ = 0.0, q_, v_;
};

inline ServoMotion run_servo(PlainServo const& servo, PlainInputs const& inputs, PlainStart const& start,
                             int finer = 20) {
  return PlainServoRun(servo, inputs, start, finer).run();
}

}  // namespace torquescope::test
