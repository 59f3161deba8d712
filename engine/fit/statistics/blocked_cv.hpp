#pragma once
// Does an effect help where it was not fitted: blocks of time are left out one after the other.
//
// Fold       one of ten equal stretches of rows; rows closer to it than the guard are left out of the fit
// Fit        linear parameters of model and effect on the mismatch, shape held
// Gain       per block: energy of the mismatch predicted by the model's columns alone less that with the effect
// t          mean gain over its standard error, blocks as the sample
// Shapes     mismatch: n; model: n x k; effect: n x L
// Requires   n >= fewest_rows
// Threads    free function
// Source     Burman, Chow, Nolan 1994, doi:10.1093/biomet/81.2.351

#include <Eigen/Core>
#include <vector>

namespace torquescope {

inline constexpr Eigen::Index fewest_rows = 100;  // ten in each block

struct BlockedGain {
  double gain = 0.0;  // energy, over all blocks
  double t = 0.0;
  std::vector<double> per_block{};
};

// what is left in each block by the fit outside it, one per row
Eigen::VectorXd blocked_residuals(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns,
                                  Eigen::Index guard_rows);

// The same of blocks as short as the guard, every tenth of which is left out together: a law that acts in one stretch
// of the record is fitted on the rest of that stretch
Eigen::VectorXd interleaved_residuals(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns,
                                      Eigen::Index guard_rows);

// energy left in all blocks, each predicted by the fit outside it
double blocked_residual_energy(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns, Eigen::Index guard_rows);

// of a torque's energy the largest share in one of the blocks; 0 without any
double most_in_a_block(Eigen::VectorXd const& torque);

BlockedGain blocked_gain(Eigen::VectorXd const& mismatch, Eigen::MatrixXd const& model, Eigen::MatrixXd const& effect,
                         Eigen::Index guard_rows);

}  // namespace torquescope
