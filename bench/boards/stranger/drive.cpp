#include "stranger/drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stranger {

Drive::Drive(LoopDesign design, Rig rig, double start)
    : design_{std::move(design)},
      rig_{std::move(rig)},
      tick_s_{1 / design_.rate_hz},
      seen_before_{start},
      wanted_before_{start} {
  double const omega = 2 * std::numbers::pi * design_.bandwidth_hz;
  kp_ = rig_.inertia * omega * omega;
  kd_ = 2 * design_.damping * omega * rig_.inertia;
  ki_ = design_.kind == "pid" ? kp_ * omega / 6 : 0;
}

double Drive::tick(double wanted, double seen) {
  double const blend = -std::expm1(-2 * std::numbers::pi * design_.speed_filter_hz * tick_s_);
  speed_ += blend * ((seen - seen_before_) / tick_s_ - speed_);
  double const wanted_speed = (wanted - wanted_before_) / tick_s_;
  wanted_rate_ += 0.1 * ((wanted_speed - wanted_speed_) / tick_s_ - wanted_rate_);
  wanted_speed_ = wanted_speed;
  wanted_before_ = wanted, seen_before_ = seen;
  double const error = wanted - seen;
  double torque = 0;
  if (design_.kind == "cascade") {
    // the outer loop asks for a speed, the inner one integrates its error
    double const omega = 2 * std::numbers::pi * design_.bandwidth_hz;
    double const speed_error = omega / 2.5 * error + wanted_speed - speed_;
    sum_ += tick_s_ * speed_error;
    torque = 2 * design_.damping * omega * rig_.inertia * (speed_error + omega / 4 * sum_);
  } else if (design_.kind == "stiff_spring") {
    // a hobby servo: nothing but the error, and the speed as a brake
    torque = kp_ * error - 0.35 * kd_ * speed_;
  } else {
    sum_ += tick_s_ * error;
    torque = kp_ * error + ki_ * sum_ + kd_ * (wanted_speed - speed_);
  }
  double const side = std::tanh(wanted_speed / (0.01 * rig_.top_speed));
  torque += design_.feedforward * (rig_.inertia * wanted_rate_ + rig_.viscous * wanted_speed + rig_.dry_forward * side +
                                   rig_.weight * std::sin(wanted - rig_.hang));
  double const limited = std::clamp(torque, -rig_.torque_limit, rig_.torque_limit);
  if (limited != torque) sum_ *= 1 - 20 * tick_s_;  // leaks while at the limit
  return limited;
}

}  // namespace stranger
