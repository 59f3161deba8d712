#pragma once
// Writes how a result was made. What must be equal for equal bits stands in the result: /provenance. What differs from one
// attempt to the next (when, where, how many threads, who wrote which segment) stands beside it in RESULT.made.json, so that
// equal jobs give equal files, byte for byte (RESULT_FORMAT.md).
//
// Errors     those of ResultWriter; 74 when the file beside it cannot be written

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/parallel.hpp"
#include "engine/run/segment_file.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

std::string utc_now();  // "2026-03-01T12:00:00Z"

// /provenance: the program
void write_program(ResultWriter& writer);

struct Circumstances {
  ThreadChoice threads;
  std::string started;  // utc_now() when the work began; it ends now
  double seconds = 0.0;
  std::string content_sha256;  // of the result this belongs to
};
void write_circumstances(std::filesystem::path const& result, Circumstances const& made,
                         std::vector<SegmentOrigin> const& segments = {});

}  // namespace torquescope
