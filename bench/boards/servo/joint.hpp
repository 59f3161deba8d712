#pragma once
// One joint with a pendulum: a step of its motion under a voltage, with dry friction as a set.
//
// Equation   J ddq = tm - G sin q - viscous dq - dry,  tm = motor_gain command - back_emf dq; drive off: tm = 0
//            |dry| <= F, against the motion;  l = |tm + G sin q| / 2
//            F = coulomb + load_friction l + load_square l^2
//                + (stribeck_friction + load_stribeck l) exp(-(dq / stribeck_speed)^2)
//                + angle_friction sin q
//            J = inertia + m L^2 + arm_mass L^2 / 3,  G = 9.80665 L (m + arm_mass / 2);  q = 0 hangs down
// Step       backward Euler of what brakes: friction holds what it can and never turns the joint round

#include "servo/servo_numbers.hpp"

namespace servo {

class Joint {
 public:
  Joint(ServoNumbers const& servo, Setting const& setting);
  void put(double position, double speed) { position_ = position, speed_ = speed; }
  void step(double command_v, bool is_on);
  double position() const { return position_; }
  double speed() const { return speed_; }
  double read() const;  // rounded to the counts of the encoder
  double gravity_moment() const { return gravity_moment_; }
  double inertia() const { return inertia_; }

 private:
  double greatest_friction(double motor_torque, double weight) const;

  ServoNumbers servo_;
  double inertia_, gravity_moment_;
  double position_ = 0.0, speed_ = 0.0;
};

}  // namespace servo
