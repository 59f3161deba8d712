#include "servo/joint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace servo {

Joint::Joint(ServoNumbers const& servo, Setting const& setting)
    : servo_(servo),
      inertia_(servo.inertia + (setting.mass_kg + servo.arm_mass / 3.0) * setting.length_m * setting.length_m),
      gravity_moment_(gravity_m_s2 * setting.length_m * (setting.mass_kg + 0.5 * servo.arm_mass)) {}

double Joint::greatest_friction(double motor_torque, double weight) const {
  double const load = 0.5 * std::abs(motor_torque + weight);
  double const pace = speed_ / servo_.stribeck_speed;
  double const near_rest = (servo_.stribeck_friction + servo_.load_stribeck * load) * std::exp(-pace * pace);
  return servo_.coulomb + servo_.load_friction * load + servo_.load_square * load * load + near_rest +
         servo_.angle_friction * std::sin(position_);
}

void Joint::step(double command_v, bool is_on) {
  double const given = is_on ? servo_.motor_gain * command_v : 0.0;
  double const back_emf = is_on ? servo_.back_emf : 0.0;
  double const weight = gravity_moment_ * std::sin(position_);
  double const limit = greatest_friction(given - back_emf * speed_, weight);

  // the speed without dry friction, then as much less as friction can take, but not beyond rest
  double const mass = inertia_ + step_s * (servo_.viscous + back_emf);
  double const free = (inertia_ * speed_ + step_s * (given - weight)) / mass;
  speed_ = std::copysign(std::max(0.0, std::abs(free) - step_s * limit / mass), free);
  position_ += step_s * speed_;
}

double Joint::read() const {
  double const count = 2.0 * std::numbers::pi / encoder_counts;
  return count * std::round(position_ / count);
}

}  // namespace servo
