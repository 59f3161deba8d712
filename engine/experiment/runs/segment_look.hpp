#pragma once
// Segments that nobody vouches for, opened in another process: what they say of themselves comes from there.
//
// Why        checksums do not keep out who computes them, and HDF5 crashes on some such files. A process costs as much
//            as a small segment, so one looks at many; nobody opens what it has read a second time for its facts alone
// Memory     the facts of one batch
// Errors     those of SegmentFile and of `look`; 65 when HDF5 crashes, loops or takes too much memory
// Threads    as HDF5: one of the process at a time

#include <functional>
#include <optional>
#include <vector>

#include "engine/experiment/runs/segment_file.hpp"

namespace torquescope {

class SegmentLook {
 public:
  // look: reads, in the other process, what will be read of a segment later
  SegmentLook(std::vector<FilePlace> places, std::function<void(SegmentFile&)> look);

  std::vector<FilePlace> const& places() const { return places_; }
  // of the i-th, which are asked for in order; throws what is wrong with it
  SegmentFacts facts(std::size_t i);

 private:
  void look_at_batch(std::size_t first);
  SegmentFacts look_at_one(FilePlace const& place) const;

  std::vector<FilePlace> places_;
  std::function<void(SegmentFile&)> look_;
  std::size_t first_ = 0;                           // of the batch
  std::vector<std::optional<SegmentFacts>> batch_;  // nothing: to be looked at by itself, which says why
};

}  // namespace torquescope
