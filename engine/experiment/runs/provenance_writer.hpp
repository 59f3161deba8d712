#pragma once
// Writes how a result was made. What must be equal for equal bits stands in the result: /provenance. What differs from
// one attempt to the next (when, where, how many threads, who wrote which segment) stands beside it in
// RESULT.made.json, so that equal jobs give equal files, byte for byte (RESULT_FORMAT.md).
//
// Errors     those of ResultWriter; 74 when the file beside it cannot be written

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/parallel.hpp"
#include "engine/experiment/runs/segment_file.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

std::string utc_now();  // "2026-03-01T12:00:00Z"

// when the work on a result began
struct Beginning {
  std::string started = utc_now();
  std::chrono::steady_clock::time_point at = std::chrono::steady_clock::now();

  double seconds() const;  // since then
};

// what a result was made of, beside its job
struct MadeOf {
  std::vector<SegmentOrigin> segments{};
  std::string continued_sha256{};  // content of an earlier result whose searches went on; "" for none
};

// the last that is written: /provenance, then the result is published, then what stands beside it. Returns
// content_sha256
std::string finish_result(ResultWriter& writer, std::filesystem::path const& result, ThreadChoice const& threads,
                          Beginning const& beginning, MadeOf const& made_of = {});

}  // namespace torquescope
