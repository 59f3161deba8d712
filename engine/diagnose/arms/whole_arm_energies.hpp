#pragma once
// Energies of what is left on the rows of an arm, and how much of it is noise.
//
// Noise      half the mean square of the difference of neighbouring rows (von Neumann 1941,
//            doi:10.1214/aoms/1177731677), over one less the correlation that the parallel filter leaves between them
// Shapes     signals: n rows of WholeArmRows, each divided by the noise of its joint
// Units      of noise, or plain: N^2 m^2
// Threads    free functions

#include <Eigen/Core>
#include <span>

#include "engine/diagnose/arms/whole_arm_rows.hpp"

namespace torquescope {

double energy_on(Eigen::VectorXd const& of, RowBlock const& block);

// over all joints in their own units; noise: [N]
double plain_energy(WholeArmRows const& rows, Eigen::VectorXd const& noise, Eigen::VectorXd const& of, RowBlock block);

// [N] of a signal at each joint
Eigen::VectorXd energies_on(WholeArmRows const& rows, Eigen::VectorXd const& of, std::span<ArmStretch const> stretches,
                            std::size_t joints);

// [N] of noise in the residual on the rows of a stretch
Eigen::VectorXd noise_energies(WholeArmRows const& rows, Eigen::VectorXd const& residual, ArmStretch const& stretch,
                               std::size_t joints);

// of the mismatch. What is rougher than noise makes noise look larger than it is: no more is noise than is left
double explained_share(double before, double after, double noise);

// error after over error before, of the joint where it falls most; energies of each joint
double least_left_share(Eigen::VectorXd const& before, Eigen::VectorXd const& after);

}  // namespace torquescope
