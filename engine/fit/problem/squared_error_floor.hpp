#pragma once
// The least possible squared error of a linear problem, and how far above it a candidate is.
//
// Equation   gap = MSE(x) - MSE(ols) = |R (x - ols)|^2 / n with phi = Q R: no difference of near-equal numbers, never
//            negative, exact down to rounding where the subtraction ends at 1e-16 of the MSE
// Errors     Error 65 from the constructor when the data cannot tell the parameters apart
// Threads    const object, shared

#include <Eigen/Core>
#include <span>

#include "engine/fit/problem/regression_data.hpp"
#include "engine/fit/problem/row_reduction.hpp"

namespace torquescope {

class SquaredErrorFloor {
 public:
  explicit SquaredErrorFloor(RegressionData const& data);
  // with the rows reduced already
  SquaredErrorFloor(RegressionData const& data, Reductions const& reductions);

  // squared error above the least possible, as MSE and whatever the loss; NaN for a NaN candidate
  double gap(std::span<double const> candidate) const;
  Eigen::VectorXd const& least_squares() const { return least_squares_; }  // the OLS parameters
  double mse() const { return mse_; }                                      // theirs

 private:
  Eigen::VectorXd least_squares_;
  double mse_;
  Eigen::MatrixXd root_;  // upper triangular, root' root = phi' phi / n
};

}  // namespace torquescope
