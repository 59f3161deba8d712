#pragma once
// How far least-squares coefficients move when a tenth of the record is left out: what an interval must cover when a
// effect fits one part of the motion with one number and another part with another.
//
// Equation   std^2 = (B - 1) / B sum_b (theta_b - mean theta)^2, theta_b without block b of B = 10 blocks of
//            consecutive rows
// Left out   for a coefficient: blocks that hold more than half of its column's energy (an event occurs in
//            one block only); 0 when fewer than half of the blocks remain
// Shapes     signal: n rows, columns: n x k; result: k, in the units of the coefficients; n >= 10
// Threads    free function
// Source     delete-a-group jackknife: Shao, Tu 1995, section 2.3, doi:10.1007/978-1-4612-0795-5

#include <Eigen/Core>

#include <vector>

#include "engine/fit/statistics/equal_blocks.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {

// of Student's t with 9 degrees of freedom, two-sided 95 %
inline constexpr double jackknife_quantile = 2.262;

Eigen::VectorXd jackknife_deviations(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns);
// of coefficients that stay within bounds
Eigen::VectorXd jackknife_deviations(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns,
                                     CoefficientBounds const& bounds);
// without each of these blocks of rows in turn
Eigen::VectorXd jackknife_deviations(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns,
                                     CoefficientBounds const& bounds, std::vector<RowBlock> const& blocks);

}  // namespace torquescope
