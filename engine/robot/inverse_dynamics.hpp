#pragma once
// Torques of a moving arm, from its parameters (recursive Newton-Euler) or as columns of them.
//
// Equation   tau = Phi(q, dq, ddq) chi; chi = standard_parameters(): 10 numbers a link, then drive inertias
// Shapes     q, dq, ddq: N; chi: 10 N or 11 N (its length tells); Phi: N x 10 N or N x 11 N. Row j has only links >= j,
//            and the drives of the motors that turn with joint j
// Units      SI: N m, or N of a prismatic joint; gravity acts as chain.gravity says; no friction
// Threads    pure functions
// Source     Khalil and Dombre 2002, sections 9.5 and 12.3; Luh, Walker, Paul 1980, doi:10.1115/1.3149599

#include <Eigen/Core>

#include "engine/robot/serial_chain.hpp"

namespace torquescope {

using JointVector = Eigen::Ref<Eigen::VectorXd const>;

Eigen::VectorXd inverse_dynamics(SerialChain const& chain, JointVector const& parameters, JointVector const& q,
                                 JointVector const& dq, JointVector const& ddq);

Eigen::MatrixXd arm_regressor(SerialChain const& chain, JointVector const& q, JointVector const& dq,
                              JointVector const& ddq, DriveInertias drives = DriveInertias::left_out);

// tau(q, 0, 0)
Eigen::VectorXd gravity_torque(SerialChain const& chain, JointVector const& parameters, JointVector const& q);

}  // namespace torquescope
