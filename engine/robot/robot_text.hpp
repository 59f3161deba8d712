#pragma once
// The text of a robot file, and places in it.
//
// Errors     Error 66 (no such file), 74 (unreadable), 65 (more than 16 MiB)
// Threads    values

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace torquescope {

struct RobotText {
  std::string file;  // as it was given
  std::string text;

  static RobotText read(std::filesystem::path const& path);
  SourcePlace whole() const { return {file, 0, 0, 0, ""}; }
  // `length` characters from this byte on, in the line it is in
  SourcePlace place(std::size_t offset, std::size_t length = 1) const;
};

}  // namespace torquescope
