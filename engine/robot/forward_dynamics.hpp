#pragma once
// Accelerations of an arm from its torques, and its mass matrix.
//
// Equation   M(q) ddq = tau - bias(q, dq); bias = inverse_dynamics(q, dq, 0). Friction is not in it: subtract it from
//            tau
// Shapes     q, dq, tau: N; parameters: 10 N or 11 N, standard, or base values in their columns (to_standard())
// Requires   M(q) positive definite, which is_positive_definite() tells. Single links need not be bodies: massless
//            links with first moments, as base parameters have them, give the same accelerations
// Threads    pure functions
// Source     Walker and Orin 1982, doi:10.1115/1.3139699, method 3: arm_equation.hpp

#include <Eigen/Core>

#include "engine/robot/inverse_dynamics.hpp"

namespace torquescope {

Eigen::MatrixXd mass_matrix(SerialChain const& chain, JointVector const& parameters, JointVector const& q);
bool is_positive_definite(Eigen::MatrixXd const& mass_matrix);
Eigen::VectorXd forward_dynamics(SerialChain const& chain, JointVector const& parameters, JointVector const& q,
                                 JointVector const& dq, JointVector const& tau);

}  // namespace torquescope
