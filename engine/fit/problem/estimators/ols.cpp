// Ordinary least squares: the smallest squared error that any parameters can have on the recordings.
//
// Arms       every N m of every joint counts alike, as in the recording: the scale of the joints' noise is undone
// Source     seed eq. 11, solved by QR instead of the normal equations

#include <algorithm>
#include <cmath>

#include "engine/fit/problem/arm_regression.hpp"
#include "engine/fit/problem/estimator.hpp"
#include "engine/fit/problem/plain_least_squares.hpp"

namespace torquescope::estimators {
namespace {

struct OlsOptions {
  std::int64_t hac_lags = -1;

  static OptionTable<OlsOptions> const& table() {
    static OptionTable<OlsOptions> const table("estimator", "ordinary least squares", {hac_lags_option<OlsOptions>()});
    return table;
  }
};

// rows as they were recorded
LeastSquaresFit fit_unscaled(RegressionData const& data, OlsOptions const& options) {
  LeastSquaresFit fit;
  fit.weights = unscaling_weights(data);
  fit.parameters = solve_weighted(data, fit.weights);
  Eigen::VectorXd const residual = data.tau - data.phi * fit.parameters;
  auto const freedom = static_cast<double>(std::max<Eigen::Index>(data.rows() - data.parameters(), 1));
  double const variance = fit.weights.dot(residual.cwiseAbs2()) / freedom;
  auto const bread = inverse_information(data, fit.weights);
  fit.covariance_naive = variance * bread;
  fit.scale = std::sqrt(variance);
  finish_fit(fit, data, fit.weights.cwiseProduct(residual), bread, options.hac_lags);
  return fit;
}

LeastSquaresFit fit_ols(RegressionData const& data, OlsOptions const& options) {
  return data.arm ? fit_unscaled(data, options) : plain_least_squares(data, options.hac_lags);
}

}  // namespace

EstimatorChoice ols() {
  return {"ols", "ordinary least squares", "Gauss 1809; seed eq. 11", OlsOptions::table().describe(),
          prepare_with<OlsOptions>(fit_ols)};
}

}  // namespace torquescope::estimators
