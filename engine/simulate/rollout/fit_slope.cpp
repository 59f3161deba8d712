#include "engine/simulate/rollout/fit_slope.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/dense_solvers.hpp"
#include "engine/fit/problem/hac.hpp"

namespace torquescope {

using Eigen::Index;

ChannelNumbers sums_of(std::vector<TrackResiduals> const& residuals, Index point) {
  ChannelNumbers sums{};
  for (std::size_t channel = 0; channel < n_channels; ++channel) {
    for (auto const& track : residuals)
      if (track.samples[channel].size() > 0) sums[channel] += track.samples[channel].col(point).squaredNorm();
    if (!std::isfinite(sums[channel])) sums[channel] = std::numeric_limits<double>::infinity();
  }
  return sums;
}

FitSlope slope_at(FitUnknowns const& unknowns, FitPoint const& at, ChannelNumbers const& effective, double width,
                  int threads) {
  Index const p = unknowns.size();
  std::vector<FitPoint> points{at};
  Eigen::VectorXd steps(p);
  for (Index k = 0; k < p; ++k) {
    double const h = width * unknowns.scale(at, k);
    FitPoint more = at, less = at;
    more[k] = unknowns.clipped(k, more[k] + h);
    less[k] = unknowns.clipped(k, less[k] - h);
    steps[k] = more[k] - less[k];
    points.push_back(std::move(more));
    points.push_back(std::move(less));
  }
  auto const residuals = unknowns.residuals_at(points, threads);
  ChannelNumbers const sums = sums_of(residuals, 0);
  FitSlope slope{Eigen::MatrixXd::Zero(p, p), Eigen::VectorXd::Zero(p), {}, {}};
  for (auto const& track : residuals)
    for (std::size_t channel = 0; channel < n_channels; ++channel) {
      auto const& samples = track.samples[channel];
      if (samples.size() == 0 || sums[channel] == 0.0) continue;
      double const weight = std::sqrt(effective[channel] / sums[channel]);
      Eigen::MatrixXd jacobian(samples.rows(), p);
      for (Index k = 0; k < p; ++k) {
        if (steps[k] > 0.0) jacobian.col(k) = (samples.col(2 + 2 * k) - samples.col(1 + 2 * k)) * (weight / steps[k]);
        // a difference that ran away says nothing
        if (!(steps[k] > 0.0) || !jacobian.col(k).allFinite()) jacobian.col(k).setZero();
      }
      Eigen::VectorXd residual = weight * samples.col(0);
      slope.curvature += jacobian.transpose() * jacobian;
      slope.descent += jacobian.transpose() * residual;
      slope.jacobian.push_back(std::move(jacobian));
      slope.residual.push_back(std::move(residual));
    }
  return slope;
}

FitIntervals no_intervals(Index parameters) {
  Eigen::VectorXd const none = Eigen::VectorXd::Constant(parameters, std::numeric_limits<double>::quiet_NaN());
  return {none, none, none};
}

FitIntervals intervals_of(FitUnknowns const& unknowns, FitPoint const& at, FitSlope const& slope) {
  FitIntervals intervals = no_intervals(unknowns.parameters());
  std::vector<Index> free;
  for (Index k = 0; k < unknowns.size(); ++k)
    if (!unknowns.is_at_bound(at, k) && slope.curvature(k, k) > 0.0) free.push_back(k);
  if (free.empty()) return intervals;
  Index rows = 0;
  std::vector<Index> first_row{0};
  for (auto const& one : slope.residual) first_row.push_back(rows += one.size());
  Eigen::MatrixXd phi(rows, static_cast<Index>(free.size()));
  Eigen::VectorXd psi(rows);
  for (std::size_t part = 0; part < slope.residual.size(); ++part) {
    Index const n = slope.residual[part].size();
    psi.segment(first_row[part], n) = slope.residual[part];
    for (std::size_t k = 0; k < free.size(); ++k)
      phi.col(static_cast<Index>(k)).segment(first_row[part], n) = slope.jacobian[part].col(free[k]);
  }
  // columns of one size: an inertia beside a weight
  Eigen::VectorXd const size = phi.colwise().norm().transpose() / std::sqrt(static_cast<double>(rows));
  phi.array().rowwise() /= size.transpose().array();
  Eigen::MatrixXd const gram = phi.transpose() * phi;
  Eigen::MatrixXd const one = Eigen::MatrixXd::Identity(gram.rows(), gram.cols());
  RowScores const scores{phi, psi, first_row};
  std::int64_t const lags = andrews_lags(scores);
  Eigen::MatrixXd const covariance = newey_west_covariance(scores, solve_semidefinite(gram, one), lags);
  double const critical = critical_value(lags, rows);
  for (std::size_t k = 0; k < free.size(); ++k) {
    if (free[k] >= unknowns.parameters()) continue;
    auto const i = static_cast<Index>(k);
    double const error = std::sqrt(covariance(i, i)) / size[i];
    intervals.errors[free[k]] = error;
    intervals.lower[free[k]] = at.parameters[free[k]] - critical * error;
    intervals.upper[free[k]] = at.parameters[free[k]] + critical * error;
  }
  return intervals;
}

}  // namespace torquescope
