#pragma once
// The rows of each joint of an arm as one small matrix: all that weights, noise levels and pooled fits need of them.
//
// Equation   gram_j = [Phi_j tau_j]' [Phi_j tau_j]; |tau_j - Phi_j x|^2 = [-x; 1]' gram_j [-x; 1]
// Shapes     gram_j: (own + 1) x (own + 1), own = ArmModel::parameters_of(j)
// Error      squares: relative 1e-16 |tau|^2 / |residual|^2 of a residual's energy, and the square of the condition:
//            for weights, not for estimates
// Bits       the same for any number of threads
// Threads    free functions, plain record

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/fit/problem/recorded_rows.hpp"

namespace torquescope {

struct FilteredGram {
  std::vector<Eigen::Index> parameters;  // whose columns these are, ascending
  Eigen::MatrixXd gram;
  Eigen::Index rows = 0;

  double torque_energy() const { return gram(gram.rows() - 1, gram.cols() - 1); }
  double residual_energy(Eigen::Ref<Eigen::VectorXd const> const& all_parameters) const;
};

// over the moving rows of all recordings
std::vector<FilteredGram> filtered_grams(std::span<RecordedRows const> recordings, ArmModel const& model);

// of all joints, each divided by its variance [N]: information x = right is the fit
struct PooledSquares {
  Eigen::MatrixXd information;
  Eigen::VectorXd right;
};
PooledSquares pooled_squares(std::vector<FilteredGram> const& grams, Eigen::Index n_parameters,
                             Eigen::VectorXd const& variance);

// Standard deviation of each joint's residual where weights are 1 / its square: fit and weights by turns (weights from
// the errors of a fit: Gautier 1997, as estimators/wls.cpp). Each at least 1e-6 of the root mean square of the joint's
// torque: what fits exactly must not outweigh everything. That rms itself where the rows cannot tell the parameters
// apart
struct NoiseLevels {
  Eigen::VectorXd deviation;  // [N]
  int iterations = 0;
  bool converged = false;
};
NoiseLevels noise_levels(std::vector<FilteredGram> const& grams, Eigen::Index n_parameters);

}  // namespace torquescope
