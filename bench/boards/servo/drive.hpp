#pragma once
// What a servo's drive makes of its goal: a led goal, a voltage from the error that it reads, and the voltage's lag.
//
// Goal       follows the one that came, at most at goal_speed_limit, changing its speed by at most
//            goal_acceleration_limit, and brakes in time to arrive at rest
// Equation   u = command_gain (goal - read), 0 where |goal - read| < dead_band, else at least punch; |u| <= limit
//            the motor gets u through a lag of first order

#include "servo/servo_numbers.hpp"

namespace servo {

class LedGoal {
 public:
  LedGoal(double speed_limit, double acceleration_limit, double start)
      : speed_limit_(speed_limit), acceleration_limit_(acceleration_limit), goal_(start) {}
  double tick(double wanted);
  double goal() const { return goal_; }

 private:
  double arriving_speed(double way) const;

  double speed_limit_, acceleration_limit_;
  double goal_, speed_ = 0.0;
};

class Drive {
 public:
  Drive(ServoNumbers const& servo, Setting const& setting, double start);
  void tick(double wanted, double read);  // every tick of the controller
  double step(bool is_on);                // -> the motor's voltage of a step; off: 0, and the lag begins anew
  double goal() const { return led_.goal(); }

 private:
  double command(double error) const;

  ServoNumbers servo_;
  double gain_, limit_, share_;  // share of a step's change that comes through the lag
  LedGoal led_;
  double command_ = 0.0, lagged_ = 0.0;
};

}  // namespace servo
