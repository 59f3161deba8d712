#pragma once
// Names of what stands beside a result file.

#include <filesystem>

namespace torquescope {

// when, where and by whom a result was made: what differs between equal results
inline std::filesystem::path circumstances_file_of(std::filesystem::path const& result) {
  return result.string() + ".made.json";
}

// throws 64 when the file system has no room in a name for the endings of what stands beside it (".made.json" and the
// like, each first under a temporary name): hours later is too late
void refuse_long_name(std::filesystem::path const& result);

}  // namespace torquescope
