#include "engine/problem/prediction_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// residuals that are held at one time
constexpr Eigen::Index block_rows = 8192;

}  // namespace

PredictionMetrics prediction_metrics(RegressionData const& data, Eigen::VectorXd const& parameters) {
  TORQUESCOPE_EXPECT(data.rows() > 0 && parameters.size() == data.parameters());
  auto const n = static_cast<double>(data.rows());
  PredictionMetrics metrics;
  double spread = 0.0;  // sum of squares about the mean of the rows so far
  Eigen::VectorXd residual;
  for (Eigen::Index first = 0; first < data.rows(); first += block_rows) {
    Eigen::Index const count = std::min(block_rows, data.rows() - first);
    residual = data.tau.segment(first, count);
    residual.noalias() -= data.phi.middleRows(first, count) * parameters;
    metrics.sse += residual.squaredNorm();
    double const mean = residual.mean();
    // two groups of rows: their spreads, and that between their means (Chan, Golub, LeVeque 1983)
    double const share = static_cast<double>(count) / static_cast<double>(first + count);
    double const apart = mean - metrics.residual_mean;
    spread += (residual.array() - mean).square().sum() + static_cast<double>(first) * share * apart * apart;
    metrics.residual_mean += share * apart;
  }
  metrics.mse = metrics.sse / n;
  metrics.relerr = std::sqrt(metrics.sse) / data.tau.norm();
  metrics.residual_std = std::sqrt(spread / n);
  return metrics;
}

}  // namespace torquescope
