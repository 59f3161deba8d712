#pragma once
// Piecewise linear functions over the quantiles of an axis: any smooth function of it, whatever its form.
//
// Shapes     x: n; result: n x k, k <= count knots; every row sums to 1; constant x: all zero
// Threads    free function

#include <Eigen/Core>
#include <vector>

namespace torquescope {

Eigen::MatrixXd hats(Eigen::VectorXd const& x, Eigen::Index count);

// all parts in one matrix; they have equally many rows
Eigen::MatrixXd side_by_side(std::vector<Eigen::MatrixXd> const& parts);

// what least squares on the columns leaves of each signal; a little ridge, because the functions of every axis sum to
// one
Eigen::VectorXd left_of(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns);
Eigen::MatrixXd left_of(Eigen::MatrixXd const& signals, Eigen::MatrixXd const& columns);

}  // namespace torquescope
