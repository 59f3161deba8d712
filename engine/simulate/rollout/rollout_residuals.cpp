#include "engine/simulate/rollout/rollout_residuals.hpp"

#include <algorithm>
#include <limits>

#include "engine/base/parallel.hpp"

namespace torquescope {
namespace {

std::size_t groups_of(std::size_t trials) { return (trials + replicate_lanes - 1) / replicate_lanes; }

// sums of one group of lanes on one track
std::array<ChannelNumbers, replicate_lanes> group_sums(RolloutTask const& task, std::size_t track,
                                                       std::span<RolloutTrial const> trials) {
  std::array<ChannelNumbers, replicate_lanes> sums{};
  RolloutTrack const& measured = task.tracks[track];
  auto const add = [&](RolloutRows const& rows, std::size_t channel, Eigen::VectorXd const& values,
                       double const* simulated) {
    if (!task.count(track, channel)) return;
    double so_far[replicate_lanes];
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) so_far[lane] = sums[lane][channel];
    for (Eigen::Index k = 0; k < rows.samples; ++k) {
      double const value = values[rows.first + k];
      double const* const row = simulated + static_cast<std::size_t>(k) * replicate_lanes;
      for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
        so_far[lane] += (value - row[lane]) * (value - row[lane]);
    }
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) sums[lane][channel] = so_far[lane];
  };
  roll_out(measured, task.structures[track], trials, [&](RolloutRows const& rows) {
    add(rows, 0, measured.position, rows.position);
    add(rows, 1, measured.torque, rows.torque);
  });
  return sums;
}

}  // namespace

std::vector<ChannelNumbers> sums_of_squares(RolloutTask const& task, std::span<RolloutTrial const> trials,
                                            int threads) {
  std::size_t const groups = groups_of(trials.size()), tracks = task.tracks.size();
  std::vector<std::array<ChannelNumbers, replicate_lanes>> parts(groups * tracks);
  parallel_for(parts.size(), threads, [&](std::size_t item, int) {
    std::size_t const first = item / tracks * replicate_lanes;
    parts[item] =
        group_sums(task, item % tracks, trials.subspan(first, std::min(replicate_lanes, trials.size() - first)));
  });
  std::vector<ChannelNumbers> sums(trials.size());
  for (std::size_t i = 0; i < trials.size(); ++i)
    for (std::size_t channel = 0; channel < n_channels; ++channel) {
      double sum = 0.0;
      for (std::size_t track = 0; track < tracks; ++track)
        sum += parts[i / replicate_lanes * tracks + track][i % replicate_lanes][channel];
      sums[i][channel] = std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
    }
  return sums;
}

std::vector<TrackResiduals> residuals_of(RolloutTask const& task,
                                         std::vector<std::vector<RolloutTrial>> const& per_track, int threads) {
  std::size_t const tracks = task.tracks.size(), trials = per_track.front().size(), groups = groups_of(trials);
  std::vector<TrackResiduals> residuals(tracks);
  for (std::size_t track = 0; track < tracks; ++track)
    for (std::size_t channel = 0; channel < n_channels; ++channel)
      if (task.count(track, channel))
        residuals[track].samples[channel].resize(task.tracks[track].samples(), static_cast<Eigen::Index>(trials));
  parallel_for(groups * tracks, threads, [&](std::size_t item, int) {
    std::size_t const track = item % tracks, first = item / tracks * replicate_lanes;
    std::size_t const count = std::min(replicate_lanes, trials - first);
    RolloutTrack const& measured = task.tracks[track];
    Eigen::Index at = 0;
    auto const put = [&](RolloutRows const& rows, std::size_t channel, Eigen::VectorXd const& values,
                         double const* simulated) {
      if (!task.count(track, channel)) return;
      auto& samples = residuals[track].samples[channel];
      for (std::size_t lane = 0; lane < count; ++lane)
        for (Eigen::Index k = 0; k < rows.samples; ++k)
          samples(at + k, static_cast<Eigen::Index>(first + lane)) =
              values[rows.first + k] - simulated[static_cast<std::size_t>(k) * replicate_lanes + lane];
    };
    std::span<RolloutTrial const> const own(per_track[track]);
    roll_out(measured, task.structures[track], own.subspan(first, count), [&](RolloutRows const& rows) {
      put(rows, 0, measured.position, rows.position);
      put(rows, 1, measured.torque, rows.torque);
      at += rows.samples;
    });
  });
  return residuals;
}

}  // namespace torquescope
