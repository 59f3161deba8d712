#pragma once
// Where a fit of servos begins: least squares on all samples of all recordings, before anything is simulated.
//
// Equation   gain u = (J_known + J) ddq + b dq + F sign(dq) + offset + weight(q) + moment sin q, u: the command that
//            the loop gives on the measured positions; derivatives by differences over a twentieth of a second
// Scale      no known load: all torques are in units of the command, gain 1
// Rows       samples with the drive on, none at the ends
// Units      SI
// Threads    pure function

#include <Eigen/Core>
#include <vector>

#include "engine/effects/regressor.hpp"
#include "engine/simulate/rollout/rollout_model.hpp"

namespace torquescope {

struct ServoStart {
  Eigen::VectorXd terms;     // of the regressor; terms other than these begin at zero
  double motor_gain = 1.0;   // N m per unit of the command
  double damping = 0.0;      // N m s/rad: of the joint and the motor together
  bool fixes_scale = false;  // a known load says what a unit of the command is in N m
};

ServoStart servo_start(Regressor const& regressor, LoopSetting const& loop, std::vector<RolloutTrack> const& tracks);

}  // namespace torquescope
