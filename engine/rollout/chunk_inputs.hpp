#pragma once
// What goes into a segment of a track at the ticks of its loop: the reference between its samples, and the inputs of a
// chunk of ticks for all lanes.
//
// Reference  held from sample to sample, or straight; a delay that is no whole tick lies straight between two ticks
// Threads    SegmentReference: const object; ChunkInputs belongs to one thread
// Requires   the track outlives both

#include <vector>

#include "engine/rollout/loop_lanes.hpp"
#include "engine/rollout/track.hpp"
#include "kernels/aligned_doubles.hpp"

namespace torquescope {

class SegmentReference {
 public:
  SegmentReference(RolloutTrack const& track, TrackSegment const& segment) : track_(track), segment_(segment) {}

  Eigen::Index sample_of(std::size_t tick) const;
  // so many ticks after the start; before it and behind the end: the first and the last. Without a reference: where the
  // segment begins
  double at(double tick) const;

 private:
  double at_tick(std::size_t tick) const;

  RolloutTrack const& track_;
  TrackSegment segment_;
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
