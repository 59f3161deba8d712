#pragma once
// Weights of rows by their noise: coloured along the rows, louder near reversals, a random walk of dry friction.
//
// Equation   signals <- (I + W W')^(-1/2) D A signals; A: row_whitening.hpp; D: how much each row counts; W: rows x K
//            Karhunen-Loeve modes (cosines of time) of the walk about its mean, torque(t) = friction(t) * x(t),
//            whitened, in standard deviations of the noise. The same on torque and columns of the model
// Shapes     friction: torque of dry friction at every kept sample of the pipeline; signals: rows x any number
// Units      SI; variance of the walk: share of the level, squared, per second
// Threads    const object, any number of threads
// Source     generalised least squares: Aitken 1935; modes of a random walk less its mean: Watson 1961,
//            doi:10.1093/biomet/48.1-2.109

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "engine/fit/statistics/row_whitening.hpp"

namespace torquescope {

// friction random walk on one set of rows, ready to be projected out
struct WanderOnRows {
  Eigen::MatrixXd modes{};   // rows x K
  Eigen::MatrixXd shrink{};  // K x K: signals - modes * shrink * modes' * signals
};

class NoiseWeights {
 public:
  NoiseWeights() = default;  // all rows alike
  explicit NoiseWeights(RowWhitening rows) : rows_(std::move(rows)) {}

  // the same, each kept sample of the pipeline multiplied by its share, 0 to 1 (reversal_weights.hpp)
  NoiseWeights with_shares(Eigen::VectorXd shares) const;
  // the same with a friction random walk
  NoiseWeights with_wander(Eigen::VectorXd const& friction, double duration_s, double variance) const;

  // what rows near reversals count for, and nothing else
  NoiseWeights of_reversals_alone() const;

  bool are_equal() const { return rows_.is_identity() && !wanders() && !weigh_reversals(); }
  bool weigh_reversals() const { return shares_.size() > 0; }
  bool wanders() const { return modes_.size() > 0; }
  RowWhitening const& rows() const { return rows_; }

  // without the walk
  void apply_rows(Eigen::Ref<Eigen::MatrixXd> signals, std::vector<Eigen::Index> const& kept_rows) const;
  // of rows near reversals alone
  void take_shares(Eigen::Ref<Eigen::MatrixXd> signals, std::vector<Eigen::Index> const& kept_rows) const;
  WanderOnRows wander_on(std::vector<Eigen::Index> const& kept_rows) const;
  void apply(Eigen::Ref<Eigen::MatrixXd> signals, std::vector<Eigen::Index> const& kept_rows,
             WanderOnRows const& wander) const;

 private:
  RowWhitening rows_;
  Eigen::VectorXd shares_{};  // of all kept samples; empty: all count
  Eigen::MatrixXd modes_{};   // kept samples x K, in standard deviations of the noise
};

}  // namespace torquescope
