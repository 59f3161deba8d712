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

double blocked_residual_energy(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns, Eigen::Index guard_rows) {
  return blocked_residuals(signal, columns, guard_rows).squaredNorm();
}

Eigen::VectorXd interleaved_residuals(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns,
                                      Eigen::Index guard_rows) {
  TORQUESCOPE_EXPECT(signal.size() >= fewest_rows && columns.rows() == signal.size() && guard_rows > 0);
  Eigen::Index const n = signal.size(), count = std::max(n / guard_rows, n_folds);
  auto const blocks = equal_blocks(n, count);
  Eigen::VectorXd left(n);
  for (Eigen::Index fold = 0; fold < n_folds; ++fold) {
    std::vector<bool> fits(static_cast<std::size_t>(n), true);
    std::vector<Eigen::Index> rows, inside;
    for (Eigen::Index b = fold; b < count; b += n_folds) {
      auto const& block = blocks[static_cast<std::size_t>(b)];
      Eigen::Index const from = std::max<Eigen::Index>(0, block.from - guard_rows),
                         to = std::min(n, block.to + guard_rows);
      for (Eigen::Index i = from; i < to; ++i) fits[static_cast<std::size_t>(i)] = false;
      for (Eigen::Index i = block.from; i < block.to; ++i) inside.push_back(i);
    }
    for (Eigen::Index i = 0; i < n; ++i)
      if (fits[static_cast<std::size_t>(i)]) rows.push_back(i);
    Eigen::MatrixXd fit_x = columns(rows, Eigen::all);
    drop_invisible(fit_x, columns);
    Eigen::VectorXd const theta = solve_scaled(std::move(fit_x), Eigen::VectorXd(signal(rows)));
    left(inside) = signal(inside) - columns(inside, Eigen::all) * theta;
  }
  return left;
}

}  // namespace torquescope
