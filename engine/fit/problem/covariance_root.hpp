#pragma once
// Errors of parameters as independent parts, and the few that matter for a prediction.
//
// Equation   covariance = root root'; columns root z with z ~ N(0, I) has that covariance. largest_parts: columns times
//            a rotation, those whose root mean square over the rows is above `least`; their sum of squares is kept
// Threads    free functions
// Source     Golub, Van Loan 2013, Matrix Computations, sections 2.4 and 8.1, ISBN 978-1-4214-0794-4

#include <Eigen/Core>

namespace torquescope {

// [R][R]
Eigen::MatrixXd covariance_root(Eigen::MatrixXd const& covariance);
// columns: n x r; n x k, the largest first
Eigen::MatrixXd largest_parts(Eigen::MatrixXd const& columns, double least);
// r x k: the axes of a Gram matrix with more energy than that, the largest first
Eigen::MatrixXd largest_axes(Eigen::MatrixXd const& gram, double least_energy);

}  // namespace torquescope
