#pragma once
// The numbers of a joint's loop, one set; every controller of a job comes down to them (loop_form.hpp).
//
// Equation   e = goal - q,  s = feed_speed dgoal - v,  v: low-passed backward difference of the q that is read
//              u = kp e + kd s + I + feed_acceleration ddgoal + added_gain a,   dI/dt = ki e + ki_speed s
//            a dead band of the error, a least drive (punch), least <= u <= most; the integral stops where it would
//            push further into a limit, and while the drive is off
//            motor: motor_gain u, torque_delay later, through a lag, less back_emf dq while the drive is on
//            logged: u through a low-pass of log_lag
// Goal       the reference command_delay later, led by at most goal_speed and goal_acceleration
// Units      SI of the joint's kind: kp N m/rad, kd N m s/rad, ki N m/(rad s), ki_speed N m/rad; s; rad/s, rad/s^2
// Threads    plain record
// Source     cascades and feed-forward of drives: Ellis 2012, Control System Design Guide, ISBN 978-0-12-385920-4

#include <limits>

namespace torquescope {

struct LoopNumbers {
  double kp = 0.0, kd = 0.0, ki = 0.0, ki_speed = 0.0;
  double feed_speed = 0.0, feed_acceleration = 0.0;
  double added_gain = 1.0;  // torque per unit of the recording's added command
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  double speed_lag_s = 0.0;  // of the low-pass of the speed; 0: none
  double back_emf = 0.0;
  double motor_gain = 1.0;              // torque per unit of the command
  double dead_band = 0.0, punch = 0.0;  // errors that the drive takes for none; the least command of a larger one
  double goal_speed = std::numeric_limits<double>::infinity();
  double goal_acceleration = std::numeric_limits<double>::infinity();
  double command_delay_s = 0.0, torque_delay_s = 0.0, torque_lag_s = 0.0, log_lag_s = 0.0;
};

}  // namespace torquescope
