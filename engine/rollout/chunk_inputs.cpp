#include "engine/rollout/chunk_inputs.hpp"

#include <algorithm>

namespace torquescope {

Eigen::Index SegmentReference::sample_of(std::size_t tick) const {
  auto const sample = static_cast<Eigen::Index>(tick / track_.ticks_per_sample);
  return segment_.first + std::min(sample, segment_.samples - 1);
}

double SegmentReference::at_tick(std::size_t tick) const {
  Eigen::Index const sample = sample_of(tick);
  double const here = track_.reference[sample];
  std::size_t const within = tick % track_.ticks_per_sample;
  if (!track_.straight_reference || within == 0 || sample + 1 >= segment_.first + segment_.samples) return here;
  double const share = static_cast<double>(within) / static_cast<double>(track_.ticks_per_sample);
  return here + share * (track_.reference[sample + 1] - here);
}

double SegmentReference::at(double tick) const {
  if (track_.reference.size() == 0) return segment_.position;
  double const last = static_cast<double>(segment_.samples) * static_cast<double>(track_.ticks_per_sample) - 1.0;
  double const within = std::clamp(tick, 0.0, last);
  auto const before = static_cast<std::size_t>(within);
  double const share = within - static_cast<double>(before), from = at_tick(before);
  return share > 0.0 ? from + share * (at_tick(before + 1) - from) : from;
}

ChunkInputs::ChunkInputs(RolloutTrack const& track, TrackSegment const& segment, std::vector<double> const& delay_ticks)
    : track_(track),
      reference_(track, segment),
      delay_ticks_(delay_ticks),
      is_same_(std::all_of(delay_ticks.begin(), delay_ticks.end(), [&](double one) { return one == delay_ticks[0]; })),
      goal_(chunk_ticks * twin_lanes),
      added_(chunk_ticks),
      outside_(chunk_ticks),
      enabled_(chunk_ticks) {}

TickInputs ChunkInputs::at(std::size_t first_tick, std::size_t ticks) {
  std::size_t const stride = is_same_ ? 1 : twin_lanes;
  for (std::size_t row = 0; row < ticks; ++row)
    for (std::size_t lane = 0; lane < stride; ++lane)
      goal_[row * stride + lane] = reference_.at(static_cast<double>(first_tick + row) - delay_ticks_[lane]);
  auto const filled = [&](Eigen::VectorXd const& channel, std::vector<double>& rows) -> double const* {
    if (channel.size() == 0) return nullptr;
    for (std::size_t row = 0; row < ticks; ++row) rows[row] = channel[reference_.sample_of(first_tick + row)];
    return rows.data();
  };
  return {goal_.data(), stride, filled(track_.added, added_), filled(track_.outside, outside_),
          filled(track_.enabled, enabled_)};
}

}  // namespace torquescope
