#include "engine/infer/pipeline/noise_weights.hpp"

#include <cmath>
#include <numbers>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"

namespace torquescope {

NoiseWeights NoiseWeights::with_shares(Eigen::VectorXd shares) const {
  TORQUESCOPE_EXPECT(shares.size() > 0 && shares.minCoeff() >= 0.0 && shares.maxCoeff() <= 1.0);
  NoiseWeights result = *this;
  result.shares_ = std::move(shares);
  return result;
}

NoiseWeights NoiseWeights::of_reversals_alone() const {
  return weigh_reversals() ? NoiseWeights().with_shares(shares_) : NoiseWeights();
}

NoiseWeights NoiseWeights::with_wander(Eigen::VectorXd const& friction, double duration_s, double variance) const {
  constexpr Eigen::Index n_modes = 16;  // all but 4 % of it
  NoiseWeights result = *this;
  result.modes_ = {};
  if (rows_.is_identity() || !(variance > 0.0)) return result;
  Eigen::Index const n = friction.size();
  result.modes_.resize(n, n_modes);
  for (Eigen::Index k = 0; k < n_modes; ++k) {
    double const turns = static_cast<double>(k + 1) * std::numbers::pi;
    // standard deviation of the mode times its function: sqrt(variance) T / turns * sqrt(2 / T) cos(turns t / T)
    double const size = std::sqrt(2.0 * variance * duration_s) / turns / rows_.noise_std();
    for (Eigen::Index i = 0; i < n; ++i)
      result.modes_(i, k) =
          size * friction[i] * std::cos(turns * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
  }
  return result;
}

WanderOnRows NoiseWeights::wander_on(std::vector<Eigen::Index> const& kept_rows) const {
  WanderOnRows result;
  if (!wanders()) return result;
  result.modes = modes_(kept_rows, Eigen::all);
  apply_rows(result.modes, kept_rows);
  auto const squares = symmetric_axes(result.modes.transpose() * result.modes);
  // with W'W = V D^2 V': (I + W W')^(-1/2) = I - W V (1 - (1 + D^2)^(-1/2)) D^(-2) V' W'
  Eigen::VectorXd const shrink = squares.values.unaryExpr([](double square) {
    double const root = std::sqrt(1.0 + std::max(0.0, square));
    return 1.0 / (root * (root + 1.0));  // the same without a difference of near numbers
  });
  result.shrink = squares.vectors * shrink.asDiagonal() * squares.vectors.transpose();
  return result;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is a view, and what it looks at is changed
void NoiseWeights::apply_rows(Eigen::Ref<Eigen::MatrixXd> signals, std::vector<Eigen::Index> const& kept_rows) const {
  rows_.apply(signals, kept_rows);
  take_shares(signals, kept_rows);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): as above
void NoiseWeights::take_shares(Eigen::Ref<Eigen::MatrixXd> signals, std::vector<Eigen::Index> const& kept_rows) const {
  if (!weigh_reversals()) return;
  TORQUESCOPE_EXPECT(static_cast<std::size_t>(signals.rows()) == kept_rows.size());
  for (Eigen::Index column = 0; column < signals.cols(); ++column)
    for (std::size_t i = 0; i < kept_rows.size(); ++i)
      signals(static_cast<Eigen::Index>(i), column) *= shares_[kept_rows[i]];
}

void NoiseWeights::apply(Eigen::Ref<Eigen::MatrixXd> signals, std::vector<Eigen::Index> const& kept_rows,
                         WanderOnRows const& wander) const {
  apply_rows(signals, kept_rows);
  if (!wanders()) return;
  TORQUESCOPE_EXPECT(wander.modes.rows() == signals.rows());
  Eigen::MatrixXd const along = wander.shrink * (wander.modes.transpose() * signals);
  signals.noalias() -= wander.modes * along;
}

}  // namespace torquescope
