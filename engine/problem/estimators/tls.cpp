// Total least squares of an arm whose drive gains are wrong: noise of the torque is in the gains' columns too.
//
// Equation   r = (1 + g_j) tau - Phi chi - known, with noise (1 + g_j) s_j: minimise the sum of (r / (1 + g_j))^2 over
//            rows divided by s_j, by Gauss-Newton. The noise of a row is one number, that of its torque: the weighted
//            total least squares of Golub and Van Loan with as many exact columns as there are parameters
// Scale      the known part of a payload: with unknown gains alone all torques could be 0
// Errors     Error 65: gains are no parameters; a drive would push the other way; not identifiable
// Source     Gautier, Briot 2014, doi:10.1115/1.4027506; Golub, Van Loan 1980, doi:10.1137/0717073

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/problem/estimator.hpp"

namespace torquescope::estimators {
namespace {

struct TlsOptions {
  std::int64_t max_iterations = 100;
  double tolerance = 1e-10;
  std::int64_t hac_lags = -1;

  static OptionTable<TlsOptions> const& table() {
    static OptionTable<TlsOptions> const table(
        "estimator", "total least squares of an arm with model.drive_gains: parameters and errors of the gains",
        {{"max_iterations", &TlsOptions::max_iterations, "1", 1, 1000, "stops here even if not converged"},
         {"tolerance", &TlsOptions::tolerance, "1", 0.0, 0.1,
          "converged when the prediction changes by less than this share of the torque"},
         hac_lags_option<TlsOptions>()});
    return table;
  }
};

Error refused(char const* what, char const* help) {
  Problem problem;
  problem.code = ExitCode::bad_data;
  problem.key = "estimator";
  problem.what = what;
  problem.help = help;
  return Error(problem);
}

// the same problem in noise of the torque, linear about `at`: what Gauss-Newton solves
struct NoiseRows {
  Eigen::VectorXd residual;
  Eigen::MatrixXd phi;
};

NoiseRows noise_rows(RegressionData const& data, Eigen::VectorXd const& at) {
  NoiseRows rows{data.tau - data.phi * at, data.phi};
  for (std::size_t k = 0; k < data.recordings(); ++k) {
    Eigen::Index const gain = data.arm->gain_column[data.arm->joint[k]];
    Eigen::Index const first = data.first_row[k], count = data.first_row[k + 1] - first;
    double const factor = 1.0 + at[gain];
    if (!(factor > 0.0))
      throw refused("tls: a drive would push the other way than its current",
                    "give torque_per_unit the sign that makes positive torque push forwards");
    auto residual = rows.residual.segment(first, count);
    residual /= factor;
    rows.phi.middleRows(first, count) /= factor;
    // the column is - tau: without the noise that the residual shows
    rows.phi.col(gain).segment(first, count) += residual / factor;
  }
  return rows;
}

LeastSquaresFit fit_tls(RegressionData const& data, TlsOptions const& options) {
  if (!data.arm || data.arm->gain_column.empty())
    throw refused("tls has no drive gains to find",
                  "write model.drive_gains = true and recording.payload_kg = [...], or use wls");
  LeastSquaresFit fit;
  fit.parameters = solve_weighted(data, {});
  fit.converged = false;
  fit.iterations = 0;
  RegressionData linear = data;
  while (!fit.converged && fit.iterations < options.max_iterations) {
    NoiseRows rows = noise_rows(data, fit.parameters);
    linear.tau = rows.residual;
    linear.phi = std::move(rows.phi);
    Eigen::VectorXd const step = solve_weighted(linear, {});
    fit.converged = (linear.phi * step).norm() <= options.tolerance * data.tau.norm();
    fit.parameters += step;
    ++fit.iterations;
  }
  if (!fit.converged) fit.remark = "not converged within max_iterations = " + std::to_string(options.max_iterations);

  NoiseRows rows = noise_rows(data, fit.parameters);
  linear.phi = std::move(rows.phi);
  linear.tau = linear.phi * fit.parameters + rows.residual;
  auto const freedom = static_cast<double>(std::max<Eigen::Index>(data.rows() - data.parameters(), 1));
  double const variance = rows.residual.squaredNorm() / freedom;
  Eigen::MatrixXd const bread = inverse_information(linear, {});
  fit.covariance_naive = variance * bread;
  fit.scale = std::sqrt(variance);
  finish_fit(fit, linear, rows.residual, bread, options.hac_lags);
  fit.metrics = prediction_metrics(data, fit.parameters);
  return fit;
}

}  // namespace

EstimatorChoice tls() {
  return {"tls",
          "total least squares with drive gains",
          "Gautier, Briot 2014",
          TlsOptions::table().describe(),
          prepare_with<TlsOptions>(fit_tls),
          false,
          true};
}

}  // namespace torquescope::estimators
