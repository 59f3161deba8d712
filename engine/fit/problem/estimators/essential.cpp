// Essential parameters: those that the recordings are worth, fitted alone; all others are zero.
//
// Equation   while max_j e_j > ratio min_j e_j, e_j = standard error / |value|: the parameter with the largest e_j
//            goes; then least squares of the rest. A factor that all errors share, as of residuals that last, changes
//            no choice
// Arms       rows were divided by the noise of their joint (arm_regression.hpp): the weighted fit, as wls
// Result     a parameter that went is 0, its errors and interval are NaN
// Source     Pham and Gautier 1991 (statistics/essential_parameters.hpp)

#include "engine/fit/statistics/essential_parameters.hpp"

#include <fmt/format.h>

#include <limits>

#include "engine/fit/problem/estimator.hpp"
#include "engine/fit/problem/plain_least_squares.hpp"

namespace torquescope::estimators {
namespace {

struct EssentialOptions {
  double ratio = usual_essential_ratio;
  std::int64_t hac_lags = -1;

  static OptionTable<EssentialOptions> const& table() {
    static OptionTable<EssentialOptions> const table(
        "estimator", "least squares of the parameters that the recordings are worth; the others are zero",
        {{"ratio", &EssentialOptions::ratio, "1", 1.0, 1e6,
          "largest relative standard error over the smallest; whoever is beyond goes, the worst first"},
         hac_lags_option<EssentialOptions>()});
    return table;
  }
};

std::vector<Eigen::Index> essential_of(RegressionData const& data, double ratio) {
  Eigen::Index const n = data.parameters();
  Eigen::MatrixXd gram(n + 1, n + 1);
  gram.topLeftCorner(n, n).noalias() = data.phi.transpose() * data.phi;
  gram.col(n).head(n).noalias() = data.phi.transpose() * data.tau;
  gram.row(n).head(n) = gram.col(n).head(n).transpose();
  gram(n, n) = data.tau.squaredNorm();
  return essential_parameters(gram, data.rows(), ratio).kept;
}

RegressionData with_columns(RegressionData const& data, std::vector<Eigen::Index> const& kept) {
  RegressionData part = data;
  part.phi = data.phi(Eigen::all, kept);
  part.columns.clear();
  for (auto const k : kept) part.columns.push_back(data.columns[static_cast<std::size_t>(k)]);
  part.same_columns = {};
  return part;
}

// every parameter has its place again
void spread(LeastSquaresFit& fit, std::vector<Eigen::Index> const& kept, Eigen::Index n) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  auto const vector = [&](Eigen::VectorXd& values, double absent) {
    Eigen::VectorXd const part = values;
    values.setConstant(n, absent);
    values(kept) = part;
  };
  auto const matrix = [&](Eigen::MatrixXd& values) {
    Eigen::MatrixXd const part = values;
    values.setZero(n, n);
    values(kept, kept) = part;
  };
  vector(fit.parameters, 0.0);
  vector(fit.standard_error, none);
  vector(fit.standard_error_naive, none);
  matrix(fit.covariance_naive);
  matrix(fit.covariance_hac);
  Eigen::MatrixX2d const intervals = fit.ci95;
  fit.ci95.setConstant(n, 2, none);
  fit.ci95(kept, Eigen::all) = intervals;
}

LeastSquaresFit fit_essential(RegressionData const& data, EssentialOptions const& options) {
  solve_weighted(data, {});  // refuses what no estimator can fit
  auto const kept = essential_of(data, options.ratio);
  LeastSquaresFit fit = plain_least_squares(with_columns(data, kept), options.hac_lags);
  spread(fit, kept, data.parameters());
  fit.remark = fmt::format("{} of {} parameters are kept", kept.size(), data.parameters());
  return fit;
}

}  // namespace

EstimatorChoice essential() {
  return {"essential", "essential parameters", "Pham, Gautier 1991", EssentialOptions::table().describe(),
          prepare_with<EssentialOptions>(fit_essential)};
}

}  // namespace torquescope::estimators
