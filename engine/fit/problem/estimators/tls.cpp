// Total least squares of an arm whose drive gains are wrong: noise of the torque is in the gains' columns too.
//
// Equation   r = (1 + g_j) tau - Phi chi - known, with noise (1 + g_j) s_j: minimise the sum of (r / (1 + g_j))^2 over
//            rows divided by s_j, by Gauss-Newton. The noise of a row is one number, that of its torque: the weighted
//            total least squares of Golub and Van Loan with as many exact columns as there are parameters
// Scale      the known part of a payload: with unknown gains alone all torques could be 0
// Start      the stated gains: where a payload tells little, least squares of all is that of no torque at all
// Errors     Error 65: gains are no parameters; not identifiable; a gain is no tenth of the stated one or above ten
// Source     Gautier, Briot 2014, doi:10.1115/1.4027506; Golub, Van Loan 1980, doi:10.1137/0717073

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/dense_solvers.hpp"
#include "engine/base/error.hpp"
#include "engine/fit/problem/arm_model.hpp"
#include "engine/fit/problem/arm_regression.hpp"
#include "engine/fit/problem/estimator.hpp"

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

Error refused(std::string const& what, std::string const& help) {
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
    auto residual = rows.residual.segment(first, count);
    residual /= factor;
    rows.phi.middleRows(first, count) /= factor;
    // the column is - tau: without the noise that the residual shows
    rows.phi.col(gain).segment(first, count) += residual / factor;
  }
  return rows;
}

// a gain below this share of the stated one, or above its inverse, is no error of a gain: drives are stated within ten
constexpr double least_factor = 0.1;
// a step takes away at most this share of a factor: all stay positive
constexpr double most_of_a_factor = 0.5;

// with gains as stated
Eigen::VectorXd start_of(RegressionData const& stated, Eigen::Index parameters) {
  Eigen::VectorXd start = Eigen::VectorXd::Zero(parameters);
  start.head(stated.parameters()) = solve_weighted(stated, {});
  return start;
}

double step_length(RegressionData const& data, Eigen::VectorXd const& at, Eigen::VectorXd const& step) {
  double length = 1.0;
  for (auto const gain : data.arm->gain_column)
    if (step[gain] < 0.0) length = std::min(length, most_of_a_factor * (1.0 + at[gain]) / -step[gain]);
  return length;
}

// whether the joint's frictions give work under the stated sign, of a fit of its rows alone: others may be wrong
bool pushes_backwards(RegressionData const& stated, std::size_t joint) {
  auto const& model = *stated.arm->model;
  std::vector<Eigen::Index> rows, own;
  for (std::size_t k = 0; k < stated.recordings(); ++k)
    for (auto t = stated.first_row[k]; stated.arm->joint[k] == joint && t < stated.first_row[k + 1]; ++t)
      rows.push_back(t);
  for (auto const k : model.parameters_of(joint))
    if (k < stated.parameters()) own.push_back(k);
  Eigen::MatrixXd const phi = stated.phi(rows, own);
  Eigen::VectorXd const found = solve_pivoted(phi, stated.tau(rows)), signs = model.passive_signs()(own);
  double taken = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i] >= model.base().size()) {
      auto const k = static_cast<Eigen::Index>(i);
      taken += signs[k] * found[k] * phi.col(k).norm();
    }
  return taken < 0.0;
}

void expect_gains(RegressionData const& stated, RegressionData const& data, Eigen::VectorXd const& at) {
  auto const factor_of = [&](std::size_t j) { return 1.0 + at[data.arm->gain_column[j]]; };
  std::size_t lost = 0;
  while (lost < data.arm->joints() && factor_of(lost) >= least_factor && factor_of(lost) <= 1.0 / least_factor) ++lost;
  if (lost == data.arm->joints()) return;
  // one of a wrong sign spoils the gains of others
  for (std::size_t j = 0; j < data.arm->joints(); ++j)
    if (pushes_backwards(stated, j))
      throw refused(fmt::format("tls: torque of joint {} has the other sign: its frictions push", j + 1),
                    fmt::format("turn the sign of number {} of torque_per_unit", j + 1));
  throw refused(fmt::format("tls: the payload does not tell the gain of joint {}: what fits best is {:.2g} times the "
                            "stated one",
                            lost + 1, factor_of(lost)),
                "carry a heavier payload through more positions; or leave drive_gains out and use wls");
}

// a gain whose error is as large as itself is the start's, not the payload's
void expect_told(RegressionData const& data, LeastSquaresFit const& fit) {
  for (std::size_t j = 0; j < data.arm->joints(); ++j) {
    auto const gain = data.arm->gain_column[j];
    double const factor = 1.0 + fit.parameters[gain], error = std::sqrt(fit.covariance_naive(gain, gain));
    if (!(error < factor))
      throw refused(fmt::format("tls: the payload does not tell the gain of joint {}: {:.2g} times the stated one, "
                                "with an error of {:.2g}",
                                j + 1, factor, error),
                    "carry a heavier payload through more positions, and give payload_first_moments_kgm; or leave "
                    "drive_gains out and use wls");
  }
}

LeastSquaresFit fit_tls(RegressionData const& data, TlsOptions const& options) {
  if (!data.arm || data.arm->gain_column.empty())
    throw refused("tls has no drive gains to find",
                  "write model.drive_gains = true and recording.payload_kg = [...], or use wls");
  LeastSquaresFit fit;
  RegressionData const stated = with_stated_gains(data);
  fit.parameters = start_of(stated, data.parameters());
  fit.converged = false;
  fit.iterations = 0;
  RegressionData linear = data;
  while (!fit.converged && fit.iterations < options.max_iterations) {
    NoiseRows rows = noise_rows(data, fit.parameters);
    linear.tau = rows.residual;
    linear.phi = std::move(rows.phi);
    Eigen::VectorXd const step = solve_weighted(linear, {});
    fit.converged = (linear.phi * step).norm() <= options.tolerance * data.tau.norm();
    fit.parameters += step_length(data, fit.parameters, step) * step;
    ++fit.iterations;
    expect_gains(stated, data, fit.parameters);
  }
  if (!fit.converged) fit.remark = "not converged within max_iterations = " + std::to_string(options.max_iterations);

  NoiseRows rows = noise_rows(data, fit.parameters);
  linear.phi = std::move(rows.phi);
  linear.tau = linear.phi * fit.parameters + rows.residual;
  auto const freedom = static_cast<double>(std::max<Eigen::Index>(data.rows() - data.parameters(), 1));
  double const variance = rows.residual.squaredNorm() / freedom;
  Eigen::MatrixXd const bread = inverse_information(linear, {});
  fit.covariance_naive = variance * bread;
  expect_told(data, fit);
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
