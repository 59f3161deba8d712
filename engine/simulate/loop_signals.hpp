#pragma once
// What a recording tells of its loop, as views.
//
// Shapes     n samples each, evenly spaced
// Units      SI

#include <Eigen/Core>

namespace torquescope {

struct LoopSignals {
  Eigen::VectorXd const& time_s;
  Eigen::VectorXd const& reference;
  Eigen::VectorXd const& position;
  Eigen::VectorXd const& torque;
};

}  // namespace torquescope
