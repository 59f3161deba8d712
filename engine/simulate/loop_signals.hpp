#pragma once
// What a recording tells of its loop, as views.
//
// Shapes     n samples each, evenly spaced
// Torque     all that the controller asked for. Gear load: the part of it that other joints need, held as the torque is
// Units      SI

#include <Eigen/Core>

namespace torquescope {

struct LoopSignals {
  Eigen::VectorXd const& time_s;
  Eigen::VectorXd const& reference;
  Eigen::VectorXd const& position;
  Eigen::VectorXd const& torque;
  Eigen::VectorXd const* gear_load = nullptr;  // none: no other joint moves
};

}  // namespace torquescope
