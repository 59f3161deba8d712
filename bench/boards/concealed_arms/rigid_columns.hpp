#pragma once
// Torque of an arm as a linear function of its masses, by hand: a second formula beside MuJoCo's, and the columns that
// sizes are absorbed by.
//
// Columns    ten a link (m, mx, my, mz, xx, xy, xz, yy, yz, zz about the frame's origin), then for each joint its drive
//            inertia, viscous, Coulomb and constant torque: 14 n columns, n rows
// Formula    Newton and Euler in the base's frame: f = m a + (dw + w w) c m, n = I dw + w x I w + c m x a; row k is
//            the moment of all links from k on about axis k
// Units      SI

#include <Eigen/Core>

#include "concealed_arms/arm_numbers.hpp"
#include "concealed_arms/mujoco_arm.hpp"

namespace concealed_arms {

Eigen::MatrixXd torque_columns(Arm const& arm, Gravity const& gravity, Eigen::VectorXd const& q,
                               Eigen::VectorXd const& v, Eigen::VectorXd const& a);
// what the columns are multiplied with for the torque of this arm
Eigen::VectorXd parameters(Arm const& arm);

}  // namespace concealed_arms
