#include "engine/simulate/rollout/measured_drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace torquescope {
namespace {

using Eigen::Index;

// samples between the points of a difference
Index span_of(RolloutTrack const& track) {
  constexpr double span_s = 0.05;
  return std::max<Index>(1, std::llround(span_s * track.rate_hz));
}

Eigen::VectorXd slope_of(RolloutTrack const& track, Eigen::VectorXd const& values) {
  Index const n = values.size(), span = span_of(track);
  Eigen::VectorXd slope = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  for (auto const& segment : track.segments)
    for (Index k = segment.first + span; k + span < segment.first + segment.samples; ++k)
      slope[k] = (values[k + span] - values[k - span]) * track.rate_hz / (2.0 * static_cast<double>(span));
  return slope;
}

Eigen::VectorXd curvature_of(RolloutTrack const& track, Eigen::VectorXd const& values) {
  Index const n = values.size(), span = span_of(track);
  double const apart_s = static_cast<double>(span) / track.rate_hz;
  Eigen::VectorXd curvature = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  for (auto const& segment : track.segments)
    for (Index k = segment.first + span; k + span < segment.first + segment.samples; ++k)
      curvature[k] = (values[k + span] - 2.0 * values[k] + values[k - span]) / (apart_s * apart_s);
  return curvature;
}

double or_zero(double value) { return std::isfinite(value) ? value : 0.0; }

}  // namespace

MeasuredDrive measured_drive(RolloutTrack const& track, LoopNumbers const& loop) {
  Index const n = track.position.size();
  MeasuredDrive drive{{}, slope_of(track, track.position), curvature_of(track, track.position)};
  if (track.reference.size() != n) return drive;
  Eigen::VectorXd const goal_speed =
      loop.kd != 0.0 && loop.feed_speed != 0.0 ? slope_of(track, track.reference) : Eigen::VectorXd::Zero(n);
  double const most = std::min(loop.most, track.known.command_limit);
  drive.command = Eigen::VectorXd::Zero(n);
  for (Index k = 0; k < n; ++k) {
    if (!is_drive_on(track, k)) continue;
    double const error = track.reference[k] - track.position[k];
    double const slip = or_zero(loop.feed_speed * goal_speed[k] - drive.speed[k]);
    drive.command[k] = std::clamp(track.known.command_gain * (loop.kp * error + loop.kd * slip), -most, most);
  }
  return drive;
}

}  // namespace torquescope
