#pragma once
// An arm in MuJoCo: mass matrix, bias torque and inverse dynamics, and nothing else of it.
//
// Shapes     vectors of n joints; the mass matrix is n x n with the drives' inertias on its diagonal
// Friction   none here: MuJoCo's frictionloss is a softened constraint that creeps near rest (arm_loop.hpp has its own)
// Threads    one object, one thread
// Source     Todorov, Erez, Tassa 2012, doi 10.1109/IROS.2012.6386109; Debian's libmujoco

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>

#include "concealed_arms/arm_numbers.hpp"

namespace concealed_arms {

using Gravity = std::array<double, 3>;
inline constexpr Gravity upright = {0.0, 0.0, -9.81};

class MujocoArm {
 public:
  MujocoArm(Arm const& arm, Gravity const& gravity);

  // at (q, v): bias = Coriolis, centrifugal and weight
  void update(Eigen::VectorXd const& q, Eigen::VectorXd const& v);
  Eigen::MatrixXd const& mass() const { return mass_; }
  Eigen::VectorXd const& bias() const { return bias_; }
  // mj_inverse, drives included: goes through another part of MuJoCo than update()
  Eigen::VectorXd inverse(Eigen::VectorXd const& q, Eigen::VectorXd const& v, Eigen::VectorXd const& a);
  // kinetic plus potential energy by MuJoCo [J]
  double energy(Eigen::VectorXd const& q, Eigen::VectorXd const& v);

 private:
  void put(Eigen::VectorXd const& q, Eigen::VectorXd const& v);

  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
  Eigen::MatrixXd mass_;
  Eigen::VectorXd bias_;
};

std::string mjcf(Arm const& arm, Gravity const& gravity);

}  // namespace concealed_arms
