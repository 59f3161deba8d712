#pragma once
// Weights of rows by their noise: coloured along the rows, and a random walk of the dry friction level.
//
// Equation   signals <- (I + W W')^(-1/2) signals, W: rows x K Karhunen-Loeve modes (cosines of time) of the walk about
//            its mean, torque(t) = friction(t) * x(t), whitened, in standard deviations of the white noise. The same on
//            torque and columns, so that torque = columns * parameters still holds
// Shapes     friction: torque of dry friction at every kept sample of the pipeline; signals: rows x any number
// Units      SI; variance of the walk: share of the level, squared, per second
// Threads    const object, any number of threads
// Source     generalised least squares: Aitken 1935; modes of a random walk less its mean: Watson 1961,
//            doi:10.1093/biomet/48.1-2.109

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "engine/statistics/row_whitening.hpp"

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

  // the same with a friction random walk
  NoiseWeights with_wander(Eigen::VectorXd const& friction, double duration_s, double variance) const;

  bool are_equal() const { return rows_.is_identity() && !wanders(); }
  bool wanders() const { return modes_.size() > 0; }
  RowWhitening const& rows() const { return rows_; }

  WanderOnRows wander_on(std::vector<Eigen::Index> const& kept_rows) const;
  void apply(Eigen::Ref<Eigen::MatrixXd> signals, std::vector<Eigen::Index> const& kept_rows,
             WanderOnRows const& wander) const;

 private:
  RowWhitening rows_;
  Eigen::MatrixXd modes_{};  // kept samples x K, in standard deviations of the noise
};

}  // namespace torquescope
