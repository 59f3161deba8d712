#include "engine/fit/statistics/forward_columns.hpp"

#include <algorithm>

#include "engine/base/contract.hpp"
#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/fit/statistics/equal_blocks.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

Eigen::MatrixXd beside(Eigen::MatrixXd const& left, Eigen::MatrixXd const& right) {
  Eigen::MatrixXd both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

}  // namespace

std::vector<Eigen::Index> forward_columns(Eigen::VectorXd const& signal, Eigen::MatrixXd const& model,
                                          Eigen::MatrixXd const& library, std::size_t count, double own) {
  TORQUESCOPE_EXPECT(model.rows() == signal.size() && library.rows() == signal.size() && own > 0.0);
  Eigen::MatrixXd left = library - model * solve_scaled(model, library);
  Eigen::VectorXd residual = signal - model * solve_scaled(model, signal);
  Eigen::VectorXd const least = own * library.colwise().norm().transpose();
  std::vector<Eigen::Index> chosen;
  while (chosen.size() < count) {
    double most = 0.0;
    Eigen::Index best = -1;
    for (Eigen::Index k = 0; k < left.cols(); ++k) {
      double const length = left.col(k).norm();
      if (!(length > least[k])) continue;
      double const taken = std::abs(left.col(k).dot(residual)) / length;
      if (taken > most) most = taken, best = k;
    }
    if (best < 0) break;
    chosen.push_back(best);
    Eigen::VectorXd const direction = left.col(best).normalized();
    residual -= direction * direction.dot(residual);
    left -= direction * (direction.transpose() * left);
  }
  return chosen;
}

Eigen::VectorXd forward_residuals(Eigen::VectorXd const& signal, Eigen::MatrixXd const& model,
                                  Eigen::MatrixXd const& library, std::size_t count, double own,
                                  Eigen::Index guard_rows) {
  TORQUESCOPE_EXPECT(signal.size() >= fewest_rows);
  Eigen::VectorXd left(signal.size());
  for (auto const& block : equal_blocks(signal.size(), n_folds)) {
    auto const rows = rows_outside(signal.size(), block, guard_rows);
    Eigen::VectorXd const fit_y = signal(rows);
    Eigen::MatrixXd const fit_model = model(rows, Eigen::all);
    auto const chosen = forward_columns(fit_y, fit_model, library(rows, Eigen::all), count, own);
    Eigen::MatrixXd const theta = solve_scaled(beside(fit_model, library(rows, chosen)), fit_y);
    auto const inside = Eigen::seqN(block.from, block.size());
    left(inside) = signal(inside) - beside(model(inside, Eigen::all), library(inside, chosen)) * theta;
  }
  return left;
}

}  // namespace torquescope
