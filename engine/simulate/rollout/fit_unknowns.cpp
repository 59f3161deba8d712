#include "engine/simulate/rollout/fit_unknowns.hpp"

#include <algorithm>
#include <cmath>

namespace torquescope {

using Eigen::Index;

FitUnknowns::FitUnknowns(RolloutModel const& model, std::vector<RolloutTrack> const& tracks, CountedChannels counts,
                         bool fits_starts)
    : model_(model), task_{tracks, {}, counts} {
  for (auto const& track : tracks) {
    task_.structures.push_back(model.structure_for(model.start(), track.tick_s()));
    bool const is_free = fits_starts && track.drive == TrackDrive::reference && track.segments.size() == 1;
    first_start_.push_back(is_free ? n_starts_ : -1);
    if (is_free) n_starts_ += 2;
  }
  auto const& all = model.parameters();
  auto const offset = std::find_if(all.begin(), all.end(), [](auto const& one) { return one.name == "offset"; });
  if (!fits_starts || offset == all.end() || tracks.size() < 2) return;
  first_offset_ = n_starts_;
  offset_scale_ = offset->scale;
  n_starts_ += static_cast<Index>(tracks.size()) - 1;
}

double FitUnknowns::offset_step(std::size_t track, FitPoint const& point) const {
  if (first_offset_ < 0) return 0.0;
  if (track == 0) return -point.starts.tail(n_starts_ - first_offset_).sum();
  return point.starts[first_offset_ + static_cast<Index>(track) - 1];
}

FitPoint FitUnknowns::begin_at(Eigen::VectorXd const& parameters) const {
  return {parameters, Eigen::VectorXd::Zero(n_starts_)};
}

double FitUnknowns::clipped(Index k, double value) const {
  if (k >= parameters()) return value;
  auto const& one = model_.parameters()[static_cast<std::size_t>(k)];
  return std::clamp(value, one.lower, one.upper);
}

bool FitUnknowns::is_at_bound(FitPoint const& at, Index k) const {
  if (k >= parameters()) return false;
  auto const& one = model_.parameters()[static_cast<std::size_t>(k)];
  return at.parameters[k] <= one.lower || at.parameters[k] >= one.upper;
}

double FitUnknowns::scale_of_start(Index start) const {
  if (first_offset_ >= 0 && start >= first_offset_) return offset_scale_;
  // a step of the encoder, or a thousandth of the way; and ten of them a second
  constexpr double thousandth = 1e-3, ten = 10.0, hundred = 100.0;
  for (std::size_t t = 0; t < first_start_.size(); ++t) {
    if (first_start_[t] < 0 || start - first_start_[t] > 1) continue;
    auto const& measured = task_.tracks[t].position;
    double const length =
        std::max(task_.tracks[t].encoder_step, thousandth * (measured.maxCoeff() - measured.minCoeff()));
    return hundred * (start == first_start_[t] ? length : ten * length);
  }
  return 1.0;
}

double FitUnknowns::scale(FitPoint const& at, Index k) const {
  if (k >= parameters()) return scale_of_start(k - parameters());
  auto const& one = model_.parameters()[static_cast<std::size_t>(k)];
  double const here = std::abs(at.parameters[k]);
  constexpr double thousandth = 1e-3;
  bool const has_end = one.is_logarithmic || (one.lower == 0.0 && here > 0.0);
  return has_end ? std::min(one.scale, std::max(here, thousandth * one.scale)) : one.scale;
}

std::vector<RolloutTrial> FitUnknowns::trials_on(std::size_t track, std::vector<FitPoint> const& points) const {
  std::vector<RolloutTrial> trials;
  for (auto const& point : points) {
    trials.push_back(model_.trial(point.parameters));
    trials.back().offset += offset_step(track, point);
    if (first_start_[track] < 0) continue;
    trials.back().position_step = point.starts[first_start_[track]];
    trials.back().velocity_step = point.starts[first_start_[track] + 1];
  }
  return trials;
}

std::vector<TrackResiduals> FitUnknowns::residuals_at(std::vector<FitPoint> const& points, int threads) const {
  std::vector<std::vector<RolloutTrial>> trials;
  for (std::size_t track = 0; track < task_.tracks.size(); ++track) trials.push_back(trials_on(track, points));
  return residuals_of(task_, trials, threads);
}

}  // namespace torquescope
