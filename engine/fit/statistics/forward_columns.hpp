#pragma once
// A few columns of a large library, chosen one after the other, and how well they predict rows they were not chosen on.
//
// Choice     the column whose part beside the model takes most of what is left; of a column of which less than `own`
//            (a share of its length) stands beside the model, nothing is known
// Fold       ten equal stretches of rows; choice and fit on the rows outside, but for the guard
// Shapes     signal: n; model: n x k; library: n x l; left: n, the residuals on the rows left out
// Requires   n >= fewest_rows (blocked_cv.hpp), own > 0
// Threads    free functions
// Source     orthogonal least squares: Chen, Billings, Luo 1989, doi:10.1080/00207178908953472

#include <Eigen/Core>
#include <vector>

namespace torquescope {

// at most `count`, in the order of choice
std::vector<Eigen::Index> forward_columns(Eigen::VectorXd const& signal, Eigen::MatrixXd const& model,
                                          Eigen::MatrixXd const& library, std::size_t count, double own);

Eigen::VectorXd forward_residuals(Eigen::VectorXd const& signal, Eigen::MatrixXd const& model,
                                  Eigen::MatrixXd const& library, std::size_t count, double own,
                                  Eigen::Index guard_rows);

}  // namespace torquescope
