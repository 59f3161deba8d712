#pragma once
// Piecewise linear functions over the quantiles of an axis: any smooth function of it, whatever its form.
//
// Shapes     x: n; result: n x k, k <= count knots; every row sums to 1; constant x: all zero
// Threads    free function

#include <Eigen/Core>

namespace torquescope {

Eigen::MatrixXd hats(Eigen::VectorXd const& x, Eigen::Index count);

}  // namespace torquescope
