#pragma once
// What a closed form estimator returns, and what all of them share: the weighted solution and its covariances.
//
// Equation   parameters = argmin sum_t w_t (tau_t - phi_t parameters)^2, by Householder QR of the column-scaled rows,
//            block by block (row_reduction.hpp; the normal equations of the seed's eq. 11 square the condition number)
// Shapes     R parameters, n rows
// Units      covariances in products of parameter units
// Errors     Error 65 when the recordings do not excite every column (regressor_health.hpp)
// Threads    free functions, plain record

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/fit/problem/prediction_metrics.hpp"
#include "engine/fit/problem/regression_data.hpp"
#include "engine/fit/problem/row_reduction.hpp"

namespace torquescope {

// inertial parameters of every link of an arm, and its drive inertias; empty where only sums of them are estimated
struct StandardParameters {
  std::vector<std::string> names;
  Eigen::VectorXd values;
};

struct LeastSquaresFit {
  Eigen::VectorXd parameters;            // [R]
  Eigen::MatrixXd covariance_naive;      // [R][R] if the residuals were white
  Eigen::MatrixXd covariance_hac;        // [R][R] Newey-West (hac.hpp)
  Eigen::VectorXd standard_error_naive;  // [R]
  Eigen::VectorXd standard_error;        // [R] HAC
  Eigen::MatrixX2d ci95;                 // [R][2] from the HAC errors
  std::int64_t hac_lags = 0;
  PredictionMetrics metrics;  // of the unweighted residuals, on the rows of the fit
  Eigen::VectorXd weights{};  // [n] of the rows; empty: all 1
  double scale = 0.0;         // of the residuals as the estimator sees them, unit of tau
  std::int64_t iterations = 1;
  bool converged = true;
  StandardParameters standard{};
  std::string remark{};  // what a person should know: "one recording: wls is ols"
};

// weights: [n], or empty for all 1
Eigen::VectorXd solve_weighted(RegressionData const& data, Eigen::VectorXd const& weights);

// of all rows alike, reduced already (row_reduction.hpp; not looked at where rows are too few)
Eigen::VectorXd solve_reduced(RegressionData const& data, Reductions const& reductions);

// (sum_t d_t phi_t phi_t')^-1, d: [n], or empty for all 1
Eigen::MatrixXd inverse_information(RegressionData const& data, Eigen::VectorXd const& d);

// fills metrics, covariance_hac, standard errors and intervals from parameters, covariance_naive and weights;
// psi: [n] of the scores s_t = phi_t psi_t (hac.hpp); hac_lags: -1 for automatic
void finish_fit(LeastSquaresFit& fit, RegressionData const& data, Eigen::VectorXd const& psi,
                Eigen::MatrixXd const& bread, std::int64_t hac_lags);

}  // namespace torquescope
