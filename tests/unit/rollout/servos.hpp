#pragma once
// The engine's words for a plain servo (plain_servo.hpp), and one that cheap hardware has.

#include <numbers>
#include <vector>

#include "unit/rollout/loops.hpp"
#include "unit/rollout/plain_servo.hpp"

namespace torquescope::test {

inline RolloutTrial trial_of(PlainServo const& servo) {
  using enum LoopKey;
  RolloutTrial trial;
  trial.joint = {servo.inertia, servo.viscous, servo.weight, 0.0};
  trial.forward = servo.coulomb;
  trial.backward = -servo.coulomb;
  trial.offset = servo.offset;
  LoopValues values;
  values[kp] = servo.gain;
  values[torque_limit] = servo.limit;
  values[motor_gain] = servo.motor_gain;
  values[back_emf] = servo.back_emf;
  values[dead_band] = servo.dead_band;
  values[punch] = servo.punch;
  values[command_delay_s] = servo.command_delay_s;
  values[load_friction] = servo.load;
  values[load_square_friction] = servo.load_square;
  values[stribeck_friction] = servo.stribeck;
  values[load_stribeck_friction] = servo.load_stribeck;
  values[stribeck_speed] = servo.stribeck_speed;
  values[angle_friction_cos] = servo.angle_cos;
  values[angle_friction_sin] = servo.angle_sin;
  trial.loop = numbers_of(LoopForm::p, values);
  trial.gear = gear_of(values);
  trial.encoder_step = servo.encoder_step;
  return trial;
}

// two sines of a goal, and a step each way, as a servo is sent them
inline std::vector<double> servo_goals(int samples, double rate_hz, double pace = 1.0) {
  std::vector<double> goals;
  for (int k = 0; k < samples; ++k) {
    double const t = pace * k / rate_hz, turn = 2.0 * std::numbers::pi;
    double const step = std::fmod(t, 1.6) < 0.8 ? 0.0 : 0.4;
    goals.push_back(0.7 * std::sin(turn * 0.45 * t) + 0.2 * std::sin(turn * 1.3 * t + 0.7) + step);
  }
  return goals;
}

}  // namespace torquescope::test
