#include "engine/fit/problem/prediction_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"
#include "kernels/residual_moments.hpp"

namespace torquescope {
namespace {

// residuals that are held at one time: they stay in the first cache until their squares are summed
constexpr Eigen::Index rows_per_block = 1024;
constexpr std::size_t most_together = 4;

using Candidates = std::span<Eigen::VectorXd const>;

// two groups of rows: their spreads, and that between their means (Chan, Golub, LeVeque 1983)
void add_block(kernels::ResidualSums const& sums, double const* residuals, Eigen::Index first, Eigen::Index count,
               PredictionMetrics& metrics, double& spread) {
  metrics.sse += sums.squares;
  double const mean = sums.sum / static_cast<double>(count);
  double const share = static_cast<double>(count) / static_cast<double>(first + count);
  double const apart = mean - metrics.residual_mean;
  spread += kernels::squares_about(residuals, static_cast<std::size_t>(count), mean) +
            static_cast<double>(first) * share * apart * apart;
  metrics.residual_mean += share * apart;
}

}  // namespace

std::vector<PredictionMetrics> prediction_metrics(RegressionData const& data, Candidates candidates) {
  TORQUESCOPE_EXPECT(data.rows() > 0);
  auto const R = static_cast<std::size_t>(data.parameters());
  std::vector<double> parameters;
  for (auto const& candidate : candidates) {
    TORQUESCOPE_EXPECT(candidate.size() == data.parameters());
    parameters.insert(parameters.end(), candidate.begin(), candidate.end());
  }
  std::vector<PredictionMetrics> metrics(candidates.size());
  std::vector<double> spread(candidates.size(), 0.0);  // sum of squares about the mean of the rows so far
  std::vector<double> residuals(std::min(most_together, candidates.size()) *
                                static_cast<std::size_t>(std::min(rows_per_block, data.rows())));
  kernels::ResidualSums sums[most_together];
  for (Eigen::Index first = 0; first < data.rows(); first += rows_per_block) {
    Eigen::Index const count = std::min(rows_per_block, data.rows() - first);
    auto const rows = static_cast<std::size_t>(count);
    kernels::SampleColumns const block{data.phi.data() + first, static_cast<std::size_t>(data.phi.outerStride()),
                                       data.tau.data() + first, rows, R};
    for (std::size_t c = 0; c < candidates.size(); c += most_together) {
      std::size_t const together = std::min(most_together, candidates.size() - c);
      kernels::residual_sums(block, parameters.data() + c * R, together, residuals.data(), sums);
      for (std::size_t i = 0; i < together; ++i)
        add_block(sums[i], residuals.data() + i * rows, first, count, metrics[c + i], spread[c + i]);
    }
  }
  double const torque = data.tau.norm(), n = static_cast<double>(data.rows());
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    metrics[c].mse = metrics[c].sse / n;
    metrics[c].relerr = std::sqrt(metrics[c].sse) / torque;
    metrics[c].residual_std = std::sqrt(spread[c] / n);
  }
  return metrics;
}

PredictionMetrics prediction_metrics(RegressionData const& data, Eigen::VectorXd const& parameters) {
  return prediction_metrics(data, Candidates(&parameters, 1)).front();
}

}  // namespace torquescope
