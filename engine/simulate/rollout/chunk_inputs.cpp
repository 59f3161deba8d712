#include "engine/simulate/rollout/chunk_inputs.hpp"

namespace torquescope {

SegmentReference::SegmentReference(RolloutTrack const& track, TrackSegment const& segment)
    : track_(track), segment_(segment) {
  if (track.reference.size() == 0) return;
  std::size_t const ticks = static_cast<std::size_t>(segment.samples) * track.ticks_per_sample;
  last_ = static_cast<double>(ticks) - 1.0;
  for (std::size_t tick = 0; tick <= ticks; ++tick) at_ticks_.push_back(at_tick(tick));
}

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

ChunkInputs::ChunkInputs(RolloutTrack const& track, TrackSegment const& segment, std::vector<double> const& delay_ticks)
    : track_(track),
      reference_(track, segment),
      delay_ticks_(delay_ticks),
      is_same_(std::all_of(delay_ticks.begin(), delay_ticks.end(), [&](double one) { return one == delay_ticks[0]; })),
      goal_(chunk_ticks * replicate_lanes),
      added_(chunk_ticks),
      outside_(chunk_ticks),
      enabled_(chunk_ticks) {}

TickInputs ChunkInputs::at(std::size_t first_tick, std::size_t ticks) {
  std::size_t const stride = is_same_ ? 1 : replicate_lanes;
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
