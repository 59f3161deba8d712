#pragma once
// What the caller of identify(), run_shard() and merge() chooses beside the job: threads, files, how it is stopped.
//
// Threads    a plain value; the functions in it are called from any thread

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/parallel.hpp"
#include "engine/store/segment_folder.hpp"

namespace torquescope {

struct IdentifyOptions {
  ThreadChoice threads{};
  std::filesystem::path output{};
  std::function<bool()> stop_requested{};     // polled once a generation; true: what is done is saved, Error 75
  std::function<std::string()> stop_words{};  // by what: "SIGTERM", "time budget (3600 s)"
  std::function<void()> saving{};             // called before what is done is saved: by a stop, or by the result itself
  std::function<void(std::string const& topic, std::string const& text)> tell{};  // "resume", "warning"
  ShardChoice shard{};                                                            // of run_shard()
  double segment_seconds = 20.0;                                                  // between two segments, at least
  bool allow_mixed = false;           // go on from segments of another program, or another text of the job
  bool allow_full_disk = false;       // begin although the result does not seem to fit
  std::filesystem::path continued{};  // a result whose searches go on (earlier_result.hpp); empty: none
  std::function<void(std::size_t, std::size_t)>
      safe{};  // runs that a power cut cannot take any more, of all: after a segment
  std::vector<std::filesystem::path> more_segments{};  // folders beside OUTPUT.parts: of merge
};

}  // namespace torquescope
