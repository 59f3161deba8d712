#pragma once
// How well parameters predict a torque: the numbers of every results table.
//
// Equation   e = tau - phi * parameters; mse = sum e^2 / n; relerr = ||e|| / ||tau||
//            residual_std is about residual_mean and over n, so mse = residual_std^2 + residual_mean^2 exactly:
//            a spread above sqrt(mse), as in the seed's Table 4, cannot be
// Units      mse, sse in (unit of tau)^2; mean and std in the unit of tau
// Threads    free function

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/fit/problem/regression_data.hpp"

namespace torquescope {

struct PredictionMetrics {
  double mse = 0.0;
  double sse = 0.0;
  double relerr = 0.0;
  double residual_mean = 0.0;
  double residual_std = 0.0;
};

PredictionMetrics prediction_metrics(RegressionData const& data, Eigen::VectorXd const& parameters);
// of several at once: the same bits from one sweep over the rows
std::vector<PredictionMetrics> prediction_metrics(RegressionData const& data,
                                                  std::span<Eigen::VectorXd const> parameters);

}  // namespace torquescope
