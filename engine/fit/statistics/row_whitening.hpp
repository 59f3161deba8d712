#pragma once
// Weights of rows whose noise is not white: encoder noise, differentiated twice, grows with the fourth power of
//            frequency.
//
// Equation   row k of an unbroken stretch: gain_m (x_k - sum_i a_mi x_(k-i)), m = min(k, order): the inverse Cholesky
//            factor of its covariance; the same on torque and columns, so that torque = columns * parameters still
//            holds. Every stretch begins anew: nothing crosses a masked reversal
// Gain       the quietest frequency below the cut-off keeps its size, louder ones shrink; results stay in torque units
// Shapes     signals: rows x any number, in time order; kept_rows: of each row, consecutive numbers are neighbours
// Threads    const object, any number of threads
// Source     Aitken 1935; Levinson, Durbin as in Brockwell, Davis 1991, section 5.2, doi:10.1007/978-1-4419-0320-4

#include <Eigen/Core>
#include <span>
#include <vector>

#include "kernels/prediction_errors.hpp"

namespace torquescope {

class RowWhitening {
 public:
  RowWhitening() = default;  // leaves rows as they are
  // covariance: of the noise at lags 0, 1, ...; quietest: least spectral density that counts, so that white noise of
  // variance `quietest` passes as it is.  Requires covariance of a stationary noise, quietest > 0
  RowWhitening(std::span<double const> covariance, double quietest);

  bool is_identity() const { return gain_ == 0.0; }
  double noise_std() const { return noise_std_; }  // of a whitened row; not for an identity
  void apply(Eigen::Ref<Eigen::MatrixXd> signals, std::span<Eigen::Index const> kept_rows) const;

 private:
  kernels::FirstPredictionErrors begin_{};  // of rows with less past than the order
  std::vector<double> past_{};              // a of the order
  double gain_ = 0.0;                       // of the order; 0: an identity
  double noise_std_ = 0.0;
};

// noise: draws of it, one per column, mean zero.  cutoff: share of the row rate up to which the filter lets signals
// through
RowWhitening whitening_of(Eigen::MatrixXd const& noise, std::span<Eigen::Index const> kept_rows, double cutoff);

}  // namespace torquescope
