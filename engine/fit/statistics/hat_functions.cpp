#include "engine/fit/statistics/hat_functions.hpp"

#include <algorithm>
#include <vector>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

// at most one row per value: equal quantiles of a discrete axis fall together
std::vector<double> quantile_knots(Eigen::VectorXd const& x, Eigen::Index count) {
  std::vector<double> sorted(x.data(), x.data() + x.size());
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> knots;
  for (Eigen::Index k = 0; k < count; ++k) {
    double const at = sorted[static_cast<std::size_t>((x.size() - 1) * k / (count - 1))];
    if (knots.empty() || at > knots.back()) knots.push_back(at);
  }
  return knots;
}

template <typename Signals>
Signals what_is_left(Signals const& signals, Eigen::MatrixXd const& columns) {
  constexpr double ridge = 1e-9;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(columns.cols(), columns.cols());
  normal.selfadjointView<Eigen::Lower>().rankUpdate(columns.transpose());
  normal.diagonal().array() += ridge * normal.trace();
  return signals - columns * solve_semidefinite(normal, Signals(columns.transpose() * signals));
}

}  // namespace

// piecewise linear, 1 at their own knot, 0 at all others
Eigen::MatrixXd hats(Eigen::VectorXd const& x, Eigen::Index count) {
  std::vector<double> const knots = quantile_knots(x, count);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(x.size(), static_cast<Eigen::Index>(knots.size()));
  if (knots.size() < 2) return out;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    auto const above = std::upper_bound(knots.begin() + 1, knots.end() - 1, x[i]);
    auto const right = static_cast<Eigen::Index>(above - knots.begin());
    double const left_knot = knots[static_cast<std::size_t>(right - 1)],
                 right_knot = knots[static_cast<std::size_t>(right)];
    double const part = (x[i] - left_knot) / (right_knot - left_knot);
    out(i, right - 1) = 1.0 - part;
    out(i, right) = part;
  }
  return out;
}

Eigen::MatrixXd side_by_side(std::vector<Eigen::MatrixXd> const& parts) {
  Eigen::Index width = 0;
  for (auto const& part : parts) width += part.cols();
  Eigen::MatrixXd all(parts.empty() ? 0 : parts.front().rows(), width);
  Eigen::Index at = 0;
  for (auto const& part : parts) {
    all.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  return all;
}

Eigen::VectorXd left_of(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns) {
  return what_is_left(signal, columns);
}

Eigen::MatrixXd left_of(Eigen::MatrixXd const& signals, Eigen::MatrixXd const& columns) {
  return what_is_left(signals, columns);
}

}  // namespace torquescope
