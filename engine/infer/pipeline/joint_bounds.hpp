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

// Which parameters cannot be negative and are by themselves all that an effect has of size. Of an effect with more of
// them one may be 0, and stands for a shape then (a damping beside a distance) that would take its place if it could be
// less
std::vector<bool> sizes_of_effects(JointModel const& model);

// what a fit heeds of them (joint_fit.hpp)
struct FitBounds {
  double least_inertia_share = 1e-3;  // of what would take all torque
  bool of_effects = true;             // false: not of those of which sizes_of_effects() are
  bool by_turns = false;              // a held inertia asks for half of the largest torque in the turns, at most
};

// a fit's parameters with 0 for what cannot be negative and is
Eigen::VectorXd without_negatives(Eigen::VectorXd fit, JointModel const& model);

}  // namespace torquescope
