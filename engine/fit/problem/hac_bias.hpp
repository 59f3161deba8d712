#pragma once
// What a HAC variance of an arm misses, because the fit has taken its share of the noise out of the residuals it sees.
//
// Equation   factor_k = N_kk / E_k under a reference noise Omega: N = B P'W Omega W P B, the variance itself;
//            E_k = sum over t, s of K(t - s) g_tk g_sk [(I - H) Omega (I - H)']_ts, what the estimator has on average;
//            P: rows phi, W: weights, B = bread, H = P B P'W, g = W P B, K: Bartlett, L lags, rows of one recording
// Reference  each joint of each recording by itself, stationary, with the tapered autocovariance of its residual; only
//            its shape matters. Unlike n / (n - R) it knows that noise is in one band, and the columns in a lower one
// Measured   47 parameters, 970 instants: factors 1.17 to 1.26, where n / (n - R) is 1.05
//            (tests/science/studies/arm_coverage.cpp)
// Threads    free function
// Source     bias under a reference distribution: Bell, McCaffrey 2002, Survey Methodology; Imbens, Kolesar 2016,
//            doi:10.1162/REST_a_00552 (of clusters; here of the Bartlett kernel)

#include <Eigen/Core>
#include <cstdint>

#include "engine/fit/problem/regression_data.hpp"

namespace torquescope {

// weights: [n] of the rows, or empty for all 1. [R]; n / (n - R) of instants where there is no noise to tell
Eigen::VectorXd hac_bias_factors(RegressionData const& data, Eigen::VectorXd const& parameters,
                                 Eigen::VectorXd const& weights, Eigen::MatrixXd const& bread, std::int64_t lags);

}  // namespace torquescope
