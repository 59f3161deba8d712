#pragma once
// What a law leaves once the rigid arm, drives, viscous, Coulomb and constant torques were fitted again.
//
// Fit        ordinary least squares of all joints together, each weighed by its noise, on the run without noise
// Band       torque and columns alike through one low-pass of 10 Hz at 500 Hz, rows at 50 Hz, as in the job
// Rows       of a joint those that move one way for as long as the filter looks: 0.1 s before and after
// SNR        rms of what is left over the rms of the noise in the same band, joint by joint

#include <Eigen/Core>

#include "concealed_arms/arm_loop.hpp"

namespace concealed_arms {

struct Left {
  Eigen::VectorXd residual_rms, noise_rms, torque_rms;  // of each joint, in the band [N m]
  double snr(int joint) const { return residual_rms[joint] / noise_rms[joint]; }
  double largest_snr() const { return residual_rms.cwiseQuotient(noise_rms).maxCoeff(); }
};

// `torque` (joints x rows) at the instants of the run's rows; the motion is what encoders show but for their steps
Left left_after_fit(Arm const& arm, ArmRun const& run, Eigen::MatrixXd const& torque, Eigen::VectorXd const& zeros);

}  // namespace concealed_arms
