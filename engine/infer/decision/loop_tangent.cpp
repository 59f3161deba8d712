#include "engine/infer/decision/loop_tangent.hpp"

#include <utility>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
constexpr double slope_width = 8e-3;

// of one channel, all tracks below each other
Eigen::MatrixXd stacked(std::vector<TrackResiduals> const& residuals, std::size_t channel) {
  Index rows = 0, columns = 0;
  for (auto const& track : residuals) {
    rows += track.samples[channel].rows();
    if (track.samples[channel].size() > 0) columns = track.samples[channel].cols();
  }
  Eigen::MatrixXd all(rows, columns);
  Index at = 0;
  for (auto const& track : residuals) {
    Index const n = track.samples[channel].rows();
    if (n > 0) all.middleRows(at, n) = track.samples[channel];
    at += n;
  }
  return all;
}

struct Sides {
  FitPoint more, less;
  double apart = 0.0;  // in scales
};

Sides sides_of(FitUnknowns const& unknowns, FitPoint const& at, Index parameter) {
  double const scale = unknowns.scale(at, parameter), h = slope_width * scale;
  Sides sides{at, at};
  sides.more[parameter] = unknowns.clipped(parameter, sides.more[parameter] + h);
  sides.less[parameter] = unknowns.clipped(parameter, sides.less[parameter] - h);
  sides.apart = (sides.more[parameter] - sides.less[parameter]) / scale;
  return sides;
}

// a difference that ran away says nothing
Eigen::VectorXd slope_between(Eigen::MatrixXd const& rows, Index less, Index more, double apart) {
  Eigen::VectorXd const slope = (rows.col(less) - rows.col(more)) / apart;
  return apart > 0.0 && slope.allFinite() ? slope : Eigen::VectorXd::Zero(rows.rows());
}

}  // namespace

std::vector<ChannelRows> columns_at(FitUnknowns const& unknowns, std::vector<FitPoint> const& at,
                                    std::vector<Index> const& parameters) {
  std::vector<FitPoint> points;
  std::vector<double> apart;
  for (auto const& point : at)
    for (Index const parameter : parameters) {
      Sides sides = sides_of(unknowns, point, parameter);
      apart.push_back(sides.apart);
      points.push_back(std::move(sides.more));
      points.push_back(std::move(sides.less));
    }
  auto const residuals = unknowns.residuals_at(points, 1);
  std::vector<ChannelRows> columns(at.size());
  auto const p = static_cast<Index>(parameters.size());
  for (std::size_t channel = 0; channel < n_channels; ++channel) {
    Eigen::MatrixXd const rows = stacked(residuals, channel);
    for (std::size_t i = 0; i < at.size(); ++i) {
      Eigen::MatrixXd& own = columns[i][channel];
      own.resize(rows.rows(), p);
      if (rows.size() == 0) continue;
      for (Index k = 0; k < p; ++k) {
        auto const pair = static_cast<Index>(i) * p + k;
        own.col(k) = slope_between(rows, 2 * pair + 1, 2 * pair, apart[static_cast<std::size_t>(pair)]);
      }
    }
  }
  return columns;
}

LoopTangent tangent_at(FitUnknowns const& unknowns, FitPoint const& at) {
  std::vector<Index> all;
  for (Index k = 0; k < unknowns.size(); ++k) all.push_back(k);
  LoopTangent tangent{std::move(columns_at(unknowns, {at}, all).front()), {}};
  auto const residuals = unknowns.residuals_at({at}, 1);
  for (std::size_t channel = 0; channel < n_channels; ++channel)
    tangent.residual[channel] = stacked(residuals, channel);
  return tangent;
}

LoopTangent beside(LoopTangent tangent, ChannelRows const& columns) {
  for (std::size_t channel = 0; channel < n_channels; ++channel) {
    Eigen::MatrixXd& all = tangent.jacobian[channel];
    Index const before = all.cols();
    all.conservativeResize(Eigen::NoChange, before + columns[channel].cols());
    all.rightCols(columns[channel].cols()) = columns[channel];
  }
  return tangent;
}

StepLeft left_after_step(LoopTangent const& to, LoopTangent const& from, ChannelRows const& rows,
                         ChannelNumbers const& weights) {
  Index const p = to.jacobian[0].cols() > 0 ? to.jacobian[0].cols() : to.jacobian[1].cols();
  Index const n = rows[0].cols() > 0 ? rows[0].cols() : rows[1].cols();
  Eigen::MatrixXd curvature = Eigen::MatrixXd::Identity(p, p), descent = Eigen::MatrixXd::Zero(p, n);
  std::array<Eigen::MatrixXd, n_channels> gram, right;
  StepLeft left;
  for (std::size_t channel = 0; channel < n_channels; ++channel) {
    if (rows[channel].rows() == 0 || weights[channel] == 0.0) continue;
    Eigen::MatrixXd const& jacobian = to.jacobian[channel];
    Eigen::VectorXd const apart = to.residual[channel].col(0) - from.residual[channel].col(0);
    gram[channel] = jacobian.transpose() * jacobian;
    right[channel] = jacobian.transpose() * rows[channel];
    right[channel].colwise() += (jacobian.transpose() * apart).eval();
    left.squares[channel] = rows[channel].colwise().squaredNorm().transpose() +
                            2.0 * (rows[channel].transpose() * apart) +
                            Eigen::VectorXd::Constant(n, apart.squaredNorm());
    curvature += weights[channel] * gram[channel];
    descent += weights[channel] * right[channel];
  }
  left.step.resize(p, n);
  for (Index k = 0; k < n; ++k) left.step.col(k) = solve_semidefinite(curvature, Eigen::VectorXd(descent.col(k)));
  for (std::size_t channel = 0; channel < n_channels; ++channel) {
    if (gram[channel].size() == 0) continue;
    left.squares[channel] +=
        (left.step.cwiseProduct(gram[channel] * left.step - 2.0 * right[channel])).colwise().sum().transpose();
    left.squares[channel] = left.squares[channel].cwiseMax(0.0);
  }
  return left;
}

}  // namespace torquescope
