#pragma once
// Where the recordings of real machines are, if they are at hand: $TORQUESCOPE_RECORDINGS, or ../shared/recordings
// beside the sources. A test without its recording skips and says so.

#include <cstdlib>
#include <filesystem>

namespace torquescope::test {

inline std::filesystem::path recordings_folder() {
  if (char const* folder = std::getenv("TORQUESCOPE_RECORDINGS")) return folder;
  return std::filesystem::path(TORQUESCOPE_SOURCE_DIR) / ".." / "shared" / "recordings";
}

}  // namespace torquescope::test

#define SKIP_WITHOUT(recording)            \
  if (!std::filesystem::exists(recording)) \
  GTEST_SKIP() << "no " << (recording) << ": set TORQUESCOPE_RECORDINGS to the folder of recordings"
