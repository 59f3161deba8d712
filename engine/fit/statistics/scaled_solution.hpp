#pragma once
// Least squares on columns of very different size and with dependent ones among them: the smallest solution, of columns
// made equally long first.
//
// Shapes     columns: n x k; signals: n x m; solution: k x m, in the units of the columns as given
// Zero       columns get 0
// Threads    free function
// Source     Golub, Van Loan: Matrix Computations, sections 5.3.5 (column scaling) and 5.5 (complete orthogonal)

#include <Eigen/Core>

namespace torquescope {

Eigen::MatrixXd solve_scaled(Eigen::MatrixXd columns, Eigen::Ref<Eigen::MatrixXd const> const& signals);

// what no such combination imitates
Eigen::VectorXd beside_columns(Eigen::MatrixXd const& columns, Eigen::VectorXd const& signal);

// coefficients between lower and upper, k each, infinite ones allowed; lower <= 0 <= upper
struct CoefficientBounds {
  Eigen::VectorXd lower, upper;
};

// the same where no coefficient may leave its bounds: those that would are held there, the most misplaced one first,
// and the others solved again, until none would leave or gain by coming back (active set: Stark, Parker 1995)
Eigen::MatrixXd solve_scaled(Eigen::MatrixXd const& columns, Eigen::Ref<Eigen::MatrixXd const> const& signals,
                             CoefficientBounds const& bounds);

}  // namespace torquescope
