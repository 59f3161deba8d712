#pragma once
// The shortest of all parameters that fit an arm's rows alike: for predictions, where rows cannot tell some of them.
//
// Equation   argmin |D x| over the minimisers of sum_j |tau_j - Phi_j x|^2 / s_j^2, D: lengths of the pooled columns.
//            Directions with less than 1e-12 of the largest eigenvalue of the scaled Gram matrix are not in the rows
// Shapes     R parameters; deviation: [N] s_j
// Error      squares the condition: for a fit that rows tell whole use solve_weighted()
// Threads    free function
// Source     Golub, Van Loan 2013, Matrix Computations, section 5.5, ISBN 978-1-4214-0794-4

#include <Eigen/Core>
#include <vector>

#include "engine/fit/problem/filtered_grams.hpp"

namespace torquescope {

Eigen::VectorXd shortest_fit(std::vector<FilteredGram> const& grams, Eigen::Index n_parameters,
                             Eigen::VectorXd const& deviation);

}  // namespace torquescope
