#include "engine/fit/statistics/scaled_solution.hpp"

#include <algorithm>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"

namespace torquescope {

Eigen::MatrixXd solve_scaled(Eigen::MatrixXd columns, Eigen::Ref<Eigen::MatrixXd const> const& signals) {
  TORQUESCOPE_EXPECT(columns.rows() == signals.rows());
  Eigen::VectorXd const per_length =
      columns.colwise().norm().unaryExpr([](double one) { return one > 0.0 ? 1.0 / one : 1.0; });
  columns *= per_length.asDiagonal();
  return per_length.asDiagonal() * solve_shortest(columns, Eigen::MatrixXd(signals));
}

Eigen::VectorXd beside_columns(Eigen::MatrixXd const& columns, Eigen::VectorXd const& signal) {
  return signal - columns * solve_scaled(columns, signal);
}

namespace {

// one signal, columns of equal length given as r = q' columns and c = q' signal
class HeldSolution {
 public:
  HeldSolution(Eigen::MatrixXd const& r, Eigen::VectorXd const& c, CoefficientBounds const& bounds)
      : r_(r),
        c_(c),
        bounds_(bounds),
        values_(Eigen::VectorXd::Zero(r.cols())),
        is_held_(static_cast<std::size_t>(r.cols()), false) {}

  Eigen::VectorXd found() {
    Eigen::Index const most_changes = 4 * r_.cols();
    for (Eigen::Index change = 0; change < most_changes; ++change) {
      solve_free();
      if (!hold_one() && !release_one()) break;
    }
    return values_.cwiseMax(bounds_.lower).cwiseMin(bounds_.upper);
  }

 private:
  void solve_free() {
    std::vector<Eigen::Index> free;
    Eigen::VectorXd left = c_;
    for (Eigen::Index k = 0; k < values_.size(); ++k) {
      if (is_held_[static_cast<std::size_t>(k)])
        left -= values_[k] * r_.col(k);
      else
        free.push_back(k);
    }
    if (free.empty()) return;
    Eigen::MatrixXd const part = r_(Eigen::all, free);
    Eigen::VectorXd const solved = solve_shortest(part, left);
    values_(free) = solved;
  }

  bool hold_one() {
    double worst = 0.0;
    Eigen::Index which = -1;
    for (Eigen::Index k = 0; k < values_.size(); ++k) {
      if (is_held_[static_cast<std::size_t>(k)]) continue;
      double const beyond = std::max(bounds_.lower[k] - values_[k], values_[k] - bounds_.upper[k]);
      if (!(beyond > worst)) continue;
      worst = beyond;
      which = k;
    }
    if (which < 0) return false;
    values_[which] = values_[which] < bounds_.lower[which] ? bounds_.lower[which] : bounds_.upper[which];
    is_held_[static_cast<std::size_t>(which)] = true;
    return true;
  }

  bool release_one() {
    Eigen::VectorXd const uphill = r_.transpose() * (c_ - r_ * values_);
    double most = 1e-9 * c_.norm();
    Eigen::Index which = -1;
    for (Eigen::Index k = 0; k < values_.size(); ++k) {
      if (!is_held_[static_cast<std::size_t>(k)] || bounds_.lower[k] == bounds_.upper[k]) continue;
      double const inwards = values_[k] == bounds_.lower[k] ? uphill[k] : -uphill[k];
      if (!(inwards > most)) continue;
      most = inwards;
      which = k;
    }
    if (which < 0) return false;
    is_held_[static_cast<std::size_t>(which)] = false;
    return true;
  }

  Eigen::MatrixXd const& r_;
  Eigen::VectorXd const& c_;
  CoefficientBounds const& bounds_;
  Eigen::VectorXd values_;
  std::vector<bool> is_held_;
};

}  // namespace

Eigen::MatrixXd solve_scaled(Eigen::MatrixXd const& columns, Eigen::Ref<Eigen::MatrixXd const> const& signals,
                             CoefficientBounds const& bounds) {
  TORQUESCOPE_EXPECT(bounds.lower.size() == columns.cols() && bounds.upper.size() == columns.cols());
  Eigen::MatrixXd found = solve_scaled(columns, signals);
  auto const is_allowed = [&](auto const& one) {
    return (one.array() >= bounds.lower.array()).all() && (one.array() <= bounds.upper.array()).all();
  };
  std::vector<Eigen::Index> beyond;
  for (Eigen::Index i = 0; i < found.cols(); ++i)
    if (!is_allowed(found.col(i))) beyond.push_back(i);
  if (beyond.empty()) return found;
  Eigen::VectorXd const length = columns.colwise().norm().unaryExpr([](double one) { return one > 0.0 ? one : 1.0; });
  auto const [r, c] = qr_factors(columns * length.cwiseInverse().asDiagonal(), signals(Eigen::all, beyond));
  CoefficientBounds const scaled{bounds.lower.cwiseProduct(length), bounds.upper.cwiseProduct(length)};
  for (std::size_t k = 0; k < beyond.size(); ++k) {
    Eigen::VectorXd const own = c.col(static_cast<Eigen::Index>(k));
    found.col(beyond[k]) = HeldSolution(r, own, scaled).found().cwiseQuotient(length);
  }
  return found;
}

}  // namespace torquescope
