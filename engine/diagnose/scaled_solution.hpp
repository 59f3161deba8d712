#pragma once
// Least squares on columns of very different size and with dependent ones among them: the smallest solution, of columns made
// equally long first.
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

}  // namespace torquescope
