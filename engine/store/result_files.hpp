#pragma once
// Names of what stands beside a result file.

#include <filesystem>

namespace torquescope {

// when, where and by whom a result was made: what differs between equal results
inline std::filesystem::path circumstances_file_of(std::filesystem::path const& result) {
  return result.string() + ".made.json";
}

}  // namespace torquescope
