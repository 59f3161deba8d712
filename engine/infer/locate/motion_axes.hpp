#pragma once
// Where the samples of a motion lie: what every axis of a diagnosis is read from.
//
// Load       terms of the model that need position or acceleration, and the gear load of the recording's simulator; the
//            other terms are friction and offset
// Distance   travelled since the sign of velocity, or of the model's torque, last changed
// Shapes     n samples, or those rows of them that a diagnosis looks at
// Units      SI of the joint's kind
// Threads    plain record

#include <Eigen/Core>

namespace torquescope {

struct MotionAxes {
  Eigen::VectorXd time_s{}, q{}, dq{}, ddq{};
  Eigen::VectorXd load_torque{};
  Eigen::VectorXd model_torque{};             // all terms, and the gear load
  Eigen::VectorXd since_velocity_reversal{};  // rad or m
  Eigen::VectorXd since_torque_reversal{};

  // pick: VectorXd -> VectorXd, some of the samples
  template <typename Pick>
  MotionAxes picked(Pick const& pick) const {
    return {pick(time_s),
            pick(q),
            pick(dq),
            pick(ddq),
            pick(load_torque),
            pick(model_torque),
            pick(since_velocity_reversal),
            pick(since_torque_reversal)};
  }
};

}  // namespace torquescope
