#pragma once
// Which parameters of a joint's model physics bounds, told by what the terms do and not by their names.
//
// Inertia    the parameter that torque grows with per acceleration
// Friction   the parameters of dry friction: of both directions at once, or one of each
// Threads    free function

#include <Eigen/Core>
#include <vector>

#include "engine/infer/pipeline/joint_model.hpp"

namespace torquescope {

struct JointBounds {
  static constexpr Eigen::Index none = -1;
  std::vector<bool> non_negative;  // parameters of effects that cannot be negative; those of the plain model are free
  Eigen::Index inertia = none;
  Eigen::Index friction = none;                  // of both directions: drives the joint where it is negative
  Eigen::Index forward = none, backward = none;  // of one each: drive the joint where forward is less than backward

  bool has_directions() const { return forward != none && backward != none; }
};

JointBounds joint_bounds(JointModel const& model);

// a fit's parameters with 0 for what cannot be negative and is
Eigen::VectorXd without_negatives(Eigen::VectorXd fit, JointModel const& model);

}  // namespace torquescope
