// Huber's robust regression by iteratively reweighted least squares: far residuals pull with a constant force.
//
// Equation   minimise sum rho(e / s), psi(e) = e if |e| <= k s, else k s sign(e); weights w = psi(e) / e
//            s = median |e| / 0.6745, again in every iteration; k = 1.345 costs 5 % efficiency under Gaussian noise
// Errors     none beyond those of every estimator; `converged` says whether the tolerance was met
// Source     Huber 1981, Robust Statistics, chapter 7; Holland, Welsch 1977 (k = 1.345)

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/median.hpp"
#include "engine/base/order_statistic.hpp"
#include "engine/fit/problem/estimator.hpp"

namespace torquescope::estimators {
namespace {

struct IrlsOptions {
  double tuning = 1.345;
  std::int64_t max_iterations = 200;
  double tolerance = 1e-10;
  std::int64_t hac_lags = -1;

  static OptionTable<IrlsOptions> const& table() {
    static OptionTable<IrlsOptions> const table(
        "estimator", "Huber's robust regression by iteratively reweighted least squares",
        {{"tuning", &IrlsOptions::tuning, "1", 0.1, 100.0,
          "residuals beyond this many scales pull with constant force"},
         {"max_iterations", &IrlsOptions::max_iterations, "1", 1, 100000, "stops here even if not converged"},
         {"tolerance", &IrlsOptions::tolerance, "1", 0.0, 0.1,
          "converged when the prediction changes by less than this share of the torque"},
         hac_lags_option<IrlsOptions>()});
    return table;
  }
};

double median_absolute(Eigen::VectorXd const& residual) {
  auto const for_each_size = [&](auto const& visit) {
    for (double const e : residual) visit(std::abs(e));
  };
  auto const n = static_cast<std::size_t>(residual.size());
  double const middle = kth_smallest(for_each_size, n / 2);
  return n % 2 == 1 ? middle : 0.5 * (middle + kth_smallest(for_each_size, n / 2 - 1));
}

Eigen::VectorXd huber_weights(Eigen::VectorXd const& residual, double limit) {
  return residual.unaryExpr([limit](double e) { return std::abs(e) <= limit ? 1.0 : limit / std::abs(e); });
}

// Both covariances take the slope psi' as independent of the motion (Huber 1981 eq. 7.6.10): weighting phi by it row by
// row fails where one direction of motion holds nothing but far residuals.
void add_errors(LeastSquaresFit& fit, RegressionData const& data, double limit, std::int64_t hac_lags) {
  Eigen::VectorXd const residual = data.tau - data.phi * fit.parameters;
  Eigen::VectorXd const psi = fit.weights.cwiseProduct(residual);
  auto const n = static_cast<double>(data.rows());
  double const mean_slope = std::max(1.0, static_cast<double>((residual.array().abs() <= limit).count())) / n;
  double const freedom = std::max(1.0, n - static_cast<double>(data.parameters()));
  Eigen::MatrixXd const bread = inverse_information(data, {}) / mean_slope;
  fit.covariance_naive = psi.squaredNorm() / freedom / mean_slope * bread;
  finish_fit(fit, data, psi, bread, hac_lags);
}

LeastSquaresFit fit_irls(RegressionData const& data, IrlsOptions const& options) {
  LeastSquaresFit fit;
  fit.converged = false;
  fit.iterations = 0;
  fit.weights = Eigen::VectorXd::Ones(data.rows());
  fit.parameters = solve_weighted(data, {});
  // residuals of noise-free data are rounding errors: there is nothing to be robust against
  constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
  double const least_scale = rounding * data.tau.norm() / std::sqrt(static_cast<double>(data.rows()));
  double limit = 0.0;
  while (!fit.converged && fit.iterations < options.max_iterations) {
    Eigen::VectorXd const residual = data.tau - data.phi * fit.parameters;
    fit.scale = std::max(median_absolute(residual) / median_of_normal, least_scale);
    limit = options.tuning * fit.scale;
    fit.weights = huber_weights(residual, limit);
    Eigen::VectorXd const next = solve_weighted(data, fit.weights);
    double const change = (data.phi * (next - fit.parameters)).norm();
    fit.converged = change <= options.tolerance * data.tau.norm();
    fit.parameters = next;
    ++fit.iterations;
  }
  if (!fit.converged) fit.remark = "not converged within max_iterations = " + std::to_string(options.max_iterations);
  add_errors(fit, data, limit, options.hac_lags);
  return fit;
}

}  // namespace

EstimatorChoice irls() {
  return {"irls", "Huber's robust regression", "Huber 1981; Holland, Welsch 1977", IrlsOptions::table().describe(),
          prepare_with<IrlsOptions>(fit_irls)};
}

}  // namespace torquescope::estimators
