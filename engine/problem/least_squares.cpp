#include "engine/problem/least_squares.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "engine/base/contract.hpp"
#include "engine/problem/hac.hpp"
#include "engine/problem/regressor_health.hpp"

namespace torquescope {
namespace {

// QR of the weighted rows with columns of length one: W^1/2 phi D^-1 = Q R
struct ScaledQr {
  Eigen::VectorXd length;  // D
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
};

ScaledQr factorise(RegressionData const& data, Eigen::VectorXd const& root_weights) {
  if (too_few_rows(data)) throw not_identifiable(data);
  Eigen::MatrixXd rows = data.phi;
  if (root_weights.size() > 0) rows = root_weights.asDiagonal() * rows;
  ScaledQr factors;
  factors.length = rows.colwise().norm();
  // a column that the weights silence: the QR below finds the rank, not a division by zero
  for (auto& length : factors.length) length = length > 0.0 ? length : 1.0;
  rows *= factors.length.cwiseInverse().asDiagonal();
  factors.qr.setThreshold(identifiable_threshold);
  factors.qr.compute(rows);
  if (factors.qr.rank() < data.parameters()) throw not_identifiable(data);
  return factors;
}

Eigen::VectorXd roots(Eigen::VectorXd const& weights) { return weights.cwiseSqrt(); }

}  // namespace

Eigen::VectorXd solve_weighted(RegressionData const& data, Eigen::VectorXd const& weights) {
  TORQUESCOPE_EXPECT(weights.size() == 0 || weights.size() == data.rows());
  auto const root = roots(weights);
  auto const factors = factorise(data, root);
  Eigen::VectorXd const torque = root.size() > 0 ? Eigen::VectorXd(root.cwiseProduct(data.tau)) : data.tau;
  return factors.qr.solve(torque).cwiseQuotient(factors.length);
}

Eigen::MatrixXd inverse_information(RegressionData const& data, Eigen::VectorXd const& d) {
  TORQUESCOPE_EXPECT(d.size() == 0 || d.size() == data.rows());
  auto const factors = factorise(data, roots(d));
  auto const count = data.parameters();
  // (R'R)^-1 = R^-1 R^-T, then undo the pivoting and the scaling
  Eigen::MatrixXd const inverse_r =
      factors.qr.matrixR().topRows(count).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(count, count));
  Eigen::MatrixXd const unpivoted = factors.qr.colsPermutation() * inverse_r;
  Eigen::MatrixXd const unscaled = factors.length.cwiseInverse().asDiagonal() * unpivoted;
  return unscaled * unscaled.transpose();
}

void finish_fit(LeastSquaresFit& fit, RegressionData const& data, Eigen::MatrixXd const& scores,
                Eigen::MatrixXd const& bread, std::int64_t hac_lags) {
  fit.metrics = prediction_metrics(data, fit.parameters);
  fit.hac_lags =
      hac_lags >= 0 ? std::min<std::int64_t>(hac_lags, data.rows() / 2) : andrews_lags(scores, data.first_row);
  fit.covariance_hac = newey_west_covariance(scores, bread, data.first_row, fit.hac_lags);
  fit.standard_error = fit.covariance_hac.diagonal().cwiseMax(0.0).cwiseSqrt();
  fit.standard_error_naive = fit.covariance_naive.diagonal().cwiseMax(0.0).cwiseSqrt();
  double const half_width = critical_value(fit.hac_lags, data.rows());
  fit.ci95.resize(data.parameters(), 2);
  fit.ci95.col(0) = fit.parameters - half_width * fit.standard_error;
  fit.ci95.col(1) = fit.parameters + half_width * fit.standard_error;
}

}  // namespace torquescope
