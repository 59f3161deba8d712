#include "engine/fit/statistics/blocked_cv.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/fit/statistics/equal_blocks.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

// what the filter carries out of an event that was left out is no column to fit without it
void drop_invisible(Eigen::MatrixXd& fit_x, Eigen::MatrixXd const& x) {
  constexpr double visible = 0.01;  // of a column's length
  for (Eigen::Index k = 0; k < x.cols(); ++k)
    if (fit_x.col(k).norm() < visible * x.col(k).norm()) fit_x.col(k).setZero();
}

// what the fit outside the block leaves inside it
Eigen::VectorXd left_inside(RowBlock const& block, Eigen::VectorXd const& y, Eigen::MatrixXd const& x,
                            Eigen::Index guard) {
  auto const rows = rows_outside(y.size(), block, guard);
  Eigen::MatrixXd fit_x = x(rows, Eigen::all);
  drop_invisible(fit_x, x);
  Eigen::VectorXd const theta = solve_scaled(std::move(fit_x), Eigen::VectorXd(y(rows)));
  return y.segment(block.from, block.size()) - x.middleRows(block.from, block.size()) * theta;
}

}  // namespace

Eigen::VectorXd blocked_residuals(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns,
                                  Eigen::Index guard_rows) {
  TORQUESCOPE_EXPECT(signal.size() >= fewest_rows && columns.rows() == signal.size());
  Eigen::VectorXd left(signal.size());
  for (auto const& block : equal_blocks(signal.size(), n_folds))
    left.segment(block.from, block.size()) = left_inside(block, signal, columns, guard_rows);
  return left;
}

}  // namespace torquescope
