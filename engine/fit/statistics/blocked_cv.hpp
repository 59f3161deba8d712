#pragma once
// What a fit leaves where it was not fitted: blocks of time are left out one after the other.
//
// Fold       one of ten equal stretches of rows; rows closer to it than the guard are left out of the fit
// Fit        linear parameters of the columns on the signal
// Shapes     signal: n; columns: n x k
// Requires   n >= fewest_rows
// Threads    free function
// Source     Burman, Chow, Nolan 1994, doi:10.1093/biomet/81.2.351

#include <Eigen/Core>

namespace torquescope {

inline constexpr Eigen::Index fewest_rows = 100;  // ten in each block

// what is left in each block by the fit outside it, one per row
Eigen::VectorXd blocked_residuals(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns,
                                  Eigen::Index guard_rows);

}  // namespace torquescope
