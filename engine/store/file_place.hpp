#pragma once
// Where a file is, or is to be written: under a path, or under a name in a folder that was opened before, whatever the
// folder's own path leads to meanwhile (open_folder.hpp).
//
// Lifetime   the open folder outlives it
// Threads    a value

#include <fcntl.h>

#include <concepts>
#include <filesystem>
#include <string>
#include <utility>

namespace torquescope {

struct FilePlace {
  std::filesystem::path path;  // for words
  int folder = AT_FDCWD;       // as openat(2) and its kin take it, together with the name
  std::string name{};

  bool is_in_open_folder() const { return folder != AT_FDCWD; }

  FilePlace(std::convertible_to<std::filesystem::path> auto const& given) : path(given), name(path.native()) {}
  FilePlace(std::filesystem::path whole, int open_folder, std::string name_in_it)
      : path(std::move(whole)), folder(open_folder), name(std::move(name_in_it)) {}
};

}  // namespace torquescope
