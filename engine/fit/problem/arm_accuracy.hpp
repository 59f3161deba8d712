#pragma once
// How well parameters predict the torques of an arm, joint by joint and together, in N m and N again.
//
// Equation   relerr = |tau - tau_hat| / |tau|, over the moving rows, and over all; of the arm: squares
//            of all joints added
// Threads    free functions, plain record

#include <Eigen/Core>
#include <vector>

#include "engine/fit/problem/regression_data.hpp"

namespace torquescope {

struct JointAccuracy {
  Eigen::Index rows = 0, all_rows = 0;
  double torque_energy = 0.0, all_torque_energy = 0.0;      // (N m)^2 or N^2
  double residual_energy = 0.0, all_residual_energy = 0.0;  // likewise

  double relerr() const;           // over the moving rows; NaN where there is none
  double relerr_all_rows() const;  // over all rows
  double residual_rms() const;     // N m or N, over the moving rows
};

struct ArmAccuracy {
  std::vector<JointAccuracy> joints;
  JointAccuracy arm;
};

ArmAccuracy arm_accuracy(RegressionData const& moving, RegressionData const& others, Eigen::VectorXd const& parameters);

// of the moving rows alone, for many candidates
std::vector<double> arm_relerr(RegressionData const& moving, std::vector<Eigen::VectorXd> const& parameters);

}  // namespace torquescope
