#pragma once
// Keeps the number of a process's segments small: sixteen small ones become one, sixteen of those one again.
//
// Why        whoever goes on, merges or asks for the status opens every segment: ten thousand take a minute
// Order      the new segment stands safe under its name before those it was made of are removed: whenever the process
//            is killed, every generation is in one of them, or in two, and then equal
// Number     of n segments 15 for each power of 16 in n, and those that exceed most_bytes together
// Whose      those that this very process wrote; once, as it begins, those that killed processes of its share left,
//            writer by writer, so that who wrote what is still known
// Errors     none: where gathering fails, the segments stay as they are, and no more are gathered
// Threads    as HDF5: one of the process at a time

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "engine/experiment/runs/segment_file.hpp"

namespace torquescope {

inline constexpr std::size_t segments_together = 16;

class SegmentPile {
 public:
  explicit SegmentPile(std::uintmax_t most_bytes) : most_bytes_(most_bytes) {}

  // of a segment that was just written; next_name: of one more
  void add(std::filesystem::path const& segment, SegmentOrigin const& origin,
           std::function<std::filesystem::path()> const& next_name);

 private:
  std::uintmax_t most_bytes_;
  bool gathers_ = true;
  std::vector<std::vector<std::filesystem::path>> levels_;  // by how often they were gathered
};

struct LeftSegment {
  std::filesystem::path file;
  SegmentOrigin origin;
};

// Verified segments of one folder and one share, sorted by name, whose lock is ours (shard_lock.hpp): those of one
// writer become one where they are many, of about most_bytes. Whether any did: then the folder is to be listed again
bool gather_left_segments(std::vector<LeftSegment> const& left, SegmentNames names, std::uintmax_t most_bytes);

// the parts of several segments in the order in which they were written; those of a run that follow each other are one
std::vector<EstimatorParts> gathered_parts(std::vector<FilePlace> const& segments);

}  // namespace torquescope
