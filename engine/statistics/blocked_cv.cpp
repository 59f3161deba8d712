#include "engine/statistics/blocked_cv.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/statistics/equal_blocks.hpp"
#include "engine/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index n_folds = 10;

// what the fit outside the block leaves inside it
double left_inside(RowBlock const& block, Eigen::VectorXd const& y, Eigen::MatrixXd const& x, Eigen::Index guard) {
  Eigen::Index const before = std::max<Eigen::Index>(0, block.from - guard);
  Eigen::Index const after = std::min(y.size(), block.to + guard);
  Eigen::Index const n_after = y.size() - after;
  Eigen::MatrixXd fit_x(before + n_after, x.cols());
  fit_x << x.topRows(before), x.bottomRows(n_after);
  Eigen::VectorXd fit_y(before + n_after);
  fit_y << y.head(before), y.tail(n_after);
  // what the filter carries out of an event inside the block is no column to fit outside it
  constexpr double visible = 0.01;  // of a column's length
  for (Eigen::Index k = 0; k < x.cols(); ++k)
    if (fit_x.col(k).norm() < visible * x.col(k).norm()) fit_x.col(k).setZero();
  Eigen::VectorXd const theta = solve_scaled(std::move(fit_x), fit_y);
  return (y.segment(block.from, block.size()) - x.middleRows(block.from, block.size()) * theta).squaredNorm();
}

}  // namespace

double blocked_residual_energy(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns, Eigen::Index guard_rows) {
  TORQUESCOPE_EXPECT(signal.size() >= fewest_rows && columns.rows() == signal.size());
  double sum = 0.0;
  for (auto const& block : equal_blocks(signal.size(), n_folds)) sum += left_inside(block, signal, columns, guard_rows);
  return sum;
}

double most_in_a_block(Eigen::VectorXd const& torque) {
  double const whole = torque.squaredNorm();
  double most = 0.0;
  for (auto const& block : equal_blocks(torque.size(), n_folds))
    most = std::max(most, torque.segment(block.from, block.size()).squaredNorm());
  return whole > 0.0 ? most / whole : 0.0;
}

BlockedGain blocked_gain(Eigen::VectorXd const& mismatch, Eigen::MatrixXd const& model, Eigen::MatrixXd const& effect,
                         Eigen::Index guard_rows) {
  TORQUESCOPE_EXPECT(mismatch.size() >= fewest_rows && model.rows() == mismatch.size() &&
                     effect.rows() == mismatch.size());
  Eigen::MatrixXd both(mismatch.size(), model.cols() + effect.cols());
  both << model, effect;
  BlockedGain result;
  for (auto const& block : equal_blocks(mismatch.size(), n_folds)) {
    double const gain =
        left_inside(block, mismatch, model, guard_rows) - left_inside(block, mismatch, both, guard_rows);
    result.per_block.push_back(gain);
    result.gain += gain;
  }
  double const mean = result.gain / static_cast<double>(n_folds);
  double squares = 0.0;
  for (double gain : result.per_block) squares += (gain - mean) * (gain - mean);
  double const error = std::sqrt(squares / static_cast<double>(n_folds * (n_folds - 1)));
  result.t = error > 0.0 ? mean / error : 0.0;
  return result;
}

}  // namespace torquescope
