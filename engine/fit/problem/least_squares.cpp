#include "engine/fit/problem/least_squares.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"
#include "engine/fit/problem/hac.hpp"
#include "engine/fit/problem/hac_bias.hpp"
#include "engine/fit/problem/regressor_health.hpp"
#include "engine/fit/problem/row_reduction.hpp"

namespace torquescope {
namespace {

// QR of the weighted rows, reduced, with columns of length one: W^1/2 phi D^-1 = Q R
struct ScaledQr {
  Eigen::VectorXd length;  // D
  PivotedQr qr;
  Eigen::VectorXd torque;  // of the rows that the QR has seen
};

ScaledQr factorise(RegressionData const& data, Eigen::VectorXd length, ReducedRows&& reduced) {
  ScaledQr factors{std::move(length), PivotedQr(reduced.phi, identifiable_threshold), std::move(reduced.tau)};
  if (factors.qr.rank() < data.parameters()) throw not_identifiable(data);
  return factors;
}

ScaledQr factorise(RegressionData const& data, Eigen::VectorXd const& root_weights) {
  if (too_few_rows(data)) throw not_identifiable(data);
  Eigen::VectorXd lengths = column_lengths(data, root_weights);
  // a column that the weights silence: the QR finds the rank, not a division by zero
  for (auto& length : lengths) length = length > 0.0 ? length : 1.0;
  RowScaling const scaling{root_weights, lengths.cwiseInverse()};
  return factorise(data, std::move(lengths), reduce_rows(data, scaling));
}

Eigen::VectorXd solved(ScaledQr const& factors) {
  return factors.qr.solve(factors.torque).cwiseQuotient(factors.length);
}

Eigen::VectorXd roots(Eigen::VectorXd const& weights) { return weights.cwiseSqrt(); }

}  // namespace

Eigen::VectorXd solve_weighted(RegressionData const& data, Eigen::VectorXd const& weights) {
  TORQUESCOPE_EXPECT(weights.size() == 0 || weights.size() == data.rows());
  return solved(factorise(data, roots(weights)));
}

Eigen::VectorXd solve_reduced(RegressionData const& data, Reductions const& reductions) {
  if (too_few_rows(data)) throw not_identifiable(data);
  return solved(factorise(data, reductions.length, ReducedRows(reductions.unit_columns)));
}

Eigen::MatrixXd inverse_information(RegressionData const& data, Eigen::VectorXd const& d) {
  TORQUESCOPE_EXPECT(d.size() == 0 || d.size() == data.rows());
  auto const factors = factorise(data, roots(d));
  auto const count = data.parameters();
  // (R'R)^-1 = R^-1 R^-T, then undo the pivoting and the scaling
  Eigen::MatrixXd const inverse_r = factors.qr.inverse_triangle();
  Eigen::VectorXi const order = factors.qr.order();
  Eigen::MatrixXd unpivoted(count, count);
  for (Eigen::Index k = 0; k < count; ++k) unpivoted.row(order[k]) = inverse_r.row(k);
  Eigen::MatrixXd const unscaled = factors.length.cwiseInverse().asDiagonal() * unpivoted;
  return unscaled * unscaled.transpose();
}

namespace {

// covariance_hac and its lags; how many independent rows there could be at most
Eigen::Index add_covariance(LeastSquaresFit& fit, RowScores const& scores, Eigen::MatrixXd const& bread,
                            std::int64_t hac_lags) {
  Eigen::Index const n = scores.psi.size();
  fit.hac_lags = hac_lags >= 0 ? std::min<std::int64_t>(hac_lags, n / 2) : andrews_lags(scores);
  fit.covariance_hac = newey_west_covariance(scores, bread, fit.hac_lags);
  return n;
}

// of every instant of an arm: the sum over its joints
Eigen::MatrixXd scores_of_instants(RegressionData const& data, Eigen::VectorXd const& psi) {
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(data.arm->first_instant.back(), data.parameters());
  for (Eigen::Index column = 0; column < scores.cols(); ++column)
    for (Eigen::Index t = 0; t < data.rows(); ++t)
      scores(data.arm->instant[static_cast<std::size_t>(t)], column) += data.phi(t, column) * psi[t];
  return scores;
}

// what the residuals have lost to the fit, in place of the n / (n - R) that newey_west_covariance() has assumed
void restore_lost_noise(LeastSquaresFit& fit, RegressionData const& data, Eigen::MatrixXd const& bread,
                        Eigen::Index n) {
  double const rest = static_cast<double>(n - data.parameters()) / static_cast<double>(n);
  Eigen::VectorXd const roots =
      (rest * hac_bias_factors(data, fit.parameters, fit.weights, bread, fit.hac_lags)).cwiseSqrt();
  fit.covariance_hac = roots.asDiagonal() * fit.covariance_hac * roots.asDiagonal();
}

}  // namespace

void finish_fit(LeastSquaresFit& fit, RegressionData const& data, Eigen::VectorXd const& psi,
                Eigen::MatrixXd const& bread, std::int64_t hac_lags) {
  fit.metrics = prediction_metrics(data, fit.parameters);
  Eigen::Index n = 0;
  if (data.arm) {
    Eigen::MatrixXd const scores = scores_of_instants(data, psi);
    Eigen::VectorXd const ones = Eigen::VectorXd::Ones(scores.rows());
    n = add_covariance(fit, {scores, ones, data.arm->first_instant}, bread, hac_lags);
    restore_lost_noise(fit, data, bread, n);
  } else {
    n = add_covariance(fit, {data.phi, psi, data.first_row}, bread, hac_lags);
  }
  fit.standard_error = fit.covariance_hac.diagonal().cwiseMax(0.0).cwiseSqrt();
  fit.standard_error_naive = fit.covariance_naive.diagonal().cwiseMax(0.0).cwiseSqrt();
  double const half_width = critical_value(fit.hac_lags, n);
  fit.ci95.resize(data.parameters(), 2);
  fit.ci95.col(0) = fit.parameters - half_width * fit.standard_error;
  fit.ci95.col(1) = fit.parameters + half_width * fit.standard_error;
}

}  // namespace torquescope
