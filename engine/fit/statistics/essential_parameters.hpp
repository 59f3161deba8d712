#pragma once
// The parameters that a recording is worth: the least certain are left out one after the other, the others fitted
// again.
//
// Equation   while max_j e_j > ratio min_j e_j, e_j = standard error / |value|: the parameter with the largest e_j goes
// Shapes     gram: (R + 1) x (R + 1), [Phi tau]' [Phi tau] of rows with equal noise
// Threads    pure function
// Source     Pham and Gautier 1991, Essential parameters of robots, 30th IEEE Conference on Decision and Control,
//            2769-2774; FIGAROH stops an identification of the Staubli TX40 at ratio 30

#include <Eigen/Core>
#include <vector>

namespace torquescope {

inline constexpr double usual_essential_ratio = 30.0;

struct EssentialParameters {
  std::vector<Eigen::Index> kept;     // ascending
  std::vector<Eigen::Index> dropped;  // in the order they went
  Eigen::VectorXd values;             // of the kept
  Eigen::VectorXd standard_errors;    // of the kept, if rows are independent
  double residual_energy = 0.0;       // of all rows, with the kept alone
};

// Requires   ratio >= 1, more rows than R. Columns that are zero or depend on others go first
EssentialParameters essential_parameters(Eigen::MatrixXd const& gram, Eigen::Index rows, double ratio);

}  // namespace torquescope
