#pragma once
// Where a job comes from: a file, or a text that a program has made.
//
// Paths      inside a text they are relative to the folder of `path`, which need not exist
// Errors     those of read_job_file() and parse_job()

#include <filesystem>
#include <optional>
#include <string>

#include "engine/experiment/job/job.hpp"

namespace torquescope {

struct JobSource {
  std::filesystem::path path;         // stands in messages
  std::optional<std::string> text{};  // nothing: that of the file
};

Job read_source(JobSource const& source);

}  // namespace torquescope
