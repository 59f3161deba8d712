#include "engine/problem/prediction_metrics.hpp"

#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {

PredictionMetrics prediction_metrics(RegressionData const& data, Eigen::VectorXd const& parameters) {
  TORQUESCOPE_EXPECT(data.rows() > 0 && parameters.size() == data.parameters());
  Eigen::VectorXd const residual = data.tau - data.phi * parameters;
  auto const n = static_cast<double>(data.rows());
  PredictionMetrics metrics;
  metrics.sse = residual.squaredNorm();
  metrics.mse = metrics.sse / n;
  metrics.relerr = std::sqrt(metrics.sse) / data.tau.norm();
  metrics.residual_mean = residual.mean();
  metrics.residual_std = std::sqrt((residual.array() - metrics.residual_mean).square().sum() / n);
  return metrics;
}

}  // namespace torquescope
