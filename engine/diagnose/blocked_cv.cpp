#include "engine/diagnose/blocked_cv.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/diagnose/scaled_solution.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index n_folds = 10;

// what the fit outside [from, to) leaves inside it
double left_inside(Eigen::VectorXd const& y, Eigen::MatrixXd const& x, Eigen::Index from, Eigen::Index to,
                   Eigen::Index guard) {
  Eigen::Index const before = std::max<Eigen::Index>(0, from - guard);
  Eigen::Index const after = std::min(y.size(), to + guard);
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
  return (y.segment(from, to - from) - x.middleRows(from, to - from) * theta).squaredNorm();
}

}  // namespace

double blocked_residual_energy(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns, Eigen::Index guard_rows) {
  TORQUESCOPE_EXPECT(signal.size() >= fewest_rows && columns.rows() == signal.size());
  double sum = 0.0;
  for (Eigen::Index block = 0; block < n_folds; ++block)
    sum += left_inside(signal, columns, signal.size() * block / n_folds, signal.size() * (block + 1) / n_folds,
                       guard_rows);
  return sum;
}

double most_in_a_block(Eigen::VectorXd const& torque) {
  double const whole = torque.squaredNorm();
  double most = 0.0;
  for (Eigen::Index block = 0; block < n_folds; ++block) {
    Eigen::Index const from = torque.size() * block / n_folds, to = torque.size() * (block + 1) / n_folds;
    most = std::max(most, torque.segment(from, to - from).squaredNorm());
  }
  return whole > 0.0 ? most / whole : 0.0;
}

BlockedGain blocked_gain(Eigen::VectorXd const& mismatch, Eigen::MatrixXd const& model, Eigen::MatrixXd const& effect,
                         Eigen::Index guard_rows) {
  TORQUESCOPE_EXPECT(mismatch.size() >= fewest_rows && model.rows() == mismatch.size() &&
                     effect.rows() == mismatch.size());
  Eigen::MatrixXd both(mismatch.size(), model.cols() + effect.cols());
  both << model, effect;
  BlockedGain result;
  for (Eigen::Index block = 0; block < n_folds; ++block) {
    Eigen::Index const from = mismatch.size() * block / n_folds, to = mismatch.size() * (block + 1) / n_folds;
    double const gain =
        left_inside(mismatch, model, from, to, guard_rows) - left_inside(mismatch, both, from, to, guard_rows);
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
