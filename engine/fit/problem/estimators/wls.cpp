// Weighted least squares: each recording counts by the inverse of its own noise variance.
//
// Equation   w_k = (pooled variance) / (residual variance of recording k under OLS), scaled to a mean of 1 over the
//            rows
// Why        a noisy recording would otherwise decide the fit; with one recording there is nothing to weigh and WLS is
//            OLS
// Arms       each joint counts by the inverse of its noise variance, found by turns (filtered_grams.hpp): its rows were
//            divided by its noise already, and all of them count alike
// Source     Gautier 1997 (weights from the errors of a first OLS fit); Aitken 1935

#include <algorithm>
#include <cmath>

#include "engine/fit/problem/estimator.hpp"

namespace torquescope::estimators {
namespace {

struct WlsOptions {
  std::int64_t hac_lags = -1;

  static OptionTable<WlsOptions> const& table() {
    static OptionTable<WlsOptions> const table(
        "estimator", "weighted least squares, one weight per recording, or per joint of an arm",
        {hac_lags_option<WlsOptions>()});
    return table;
  }
};

// one weight per row, mean 1
Eigen::VectorXd recording_weights(RegressionData const& data, Eigen::VectorXd const& residual) {
  // a recording that OLS fits exactly must not get an infinite weight
  double const least_variance = 1e-12 * data.tau.squaredNorm() / static_cast<double>(data.rows());
  Eigen::VectorXd weights(data.rows());
  for (std::size_t k = 0; k < data.recordings(); ++k) {
    auto const first = data.first_row[k], rows = data.first_row[k + 1] - first;
    double const variance = residual.segment(first, rows).squaredNorm() / static_cast<double>(rows);
    weights.segment(first, rows).setConstant(1.0 / std::max(variance, least_variance));
  }
  return weights / weights.mean();
}

LeastSquaresFit fit_wls(RegressionData const& data, WlsOptions const& options) {
  LeastSquaresFit fit;
  fit.parameters = solve_weighted(data, {});
  if (data.arm) {
    fit.weights = Eigen::VectorXd::Ones(data.rows());
  } else if (data.recordings() > 1) {
    fit.weights = recording_weights(data, data.tau - data.phi * fit.parameters);
    fit.parameters = solve_weighted(data, fit.weights);
    fit.iterations = 2;
  } else {
    fit.weights = Eigen::VectorXd::Ones(data.rows());
    fit.remark = "one recording: every weight is 1, wls is ols";
  }
  Eigen::VectorXd const residual = data.tau - data.phi * fit.parameters;
  auto const freedom = static_cast<double>(std::max<Eigen::Index>(data.rows() - data.parameters(), 1));
  double const variance = fit.weights.dot(residual.cwiseAbs2()) / freedom;
  auto const bread = inverse_information(data, fit.weights);
  fit.covariance_naive = variance * bread;
  fit.scale = std::sqrt(variance);
  finish_fit(fit, data, fit.weights.cwiseProduct(residual), bread, options.hac_lags);
  return fit;
}

}  // namespace

EstimatorChoice wls() {
  return {"wls", "least squares weighted by recording", "Aitken 1935; Gautier 1997", WlsOptions::table().describe(),
          prepare_with<WlsOptions>(fit_wls)};
}

}  // namespace torquescope::estimators
