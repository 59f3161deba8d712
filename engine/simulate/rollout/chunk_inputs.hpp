#pragma once
// What goes into a segment of a track at the ticks of its loop: the reference between its samples, and the inputs of a
// chunk of ticks for all lanes.
//
// Reference  held from sample to sample, or straight; a delay that is no whole tick lies straight between two ticks
// Threads    SegmentReference: const object; ChunkInputs belongs to one thread
// Requires   the track outlives both

#include <algorithm>
#include <vector>

#include "engine/simulate/rollout/loop_lanes.hpp"
#include "engine/simulate/rollout/track.hpp"
#include "kernels/aligned_doubles.hpp"

namespace torquescope {

class SegmentReference {
 public:
  SegmentReference(RolloutTrack const& track, TrackSegment const& segment);

  Eigen::Index sample_of(std::size_t tick) const;
  // so many ticks after the start; before it and behind the end: the first and the last. Without a reference: where the
  // segment begins
  double at(double tick) const {
    if (at_ticks_.empty()) return segment_.position;
    double const within = std::clamp(tick, 0.0, last_);
    auto const before = static_cast<std::size_t>(within);
    double const share = within - static_cast<double>(before), from = at_ticks_[before];
    return share > 0.0 ? from + share * (at_ticks_[before + 1] - from) : from;
  }

 private:
  double at_tick(std::size_t tick) const;

  RolloutTrack const& track_;
  TrackSegment segment_;
  double last_ = 0.0;
  std::vector<double> at_ticks_{};  // of the segment, and one more; empty: there is no reference
};

class ChunkInputs {
 public:
  // delay_ticks: of the command, one per lane
  ChunkInputs(RolloutTrack const& track, TrackSegment const& segment, std::vector<double> const& delay_ticks);

  SegmentReference const& reference() const { return reference_; }
  // valid until the next call
  TickInputs at(std::size_t first_tick, std::size_t ticks);

 private:
  RolloutTrack const& track_;
  SegmentReference reference_;
  std::vector<double> delay_ticks_;
  bool is_same_;                  // all lanes see one goal
  kernels::AlignedDoubles goal_;  // on cache lines: rows are one each
  std::vector<double> added_, outside_, enabled_;
};

}  // namespace torquescope
