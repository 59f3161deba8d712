#pragma once
// A folder, opened once: what is done in it is done in that very folder, whatever its name leads to meanwhile.
//
// Whose      anybody's, also behind a link: of a folder for this program's own files alone, see own_folder.hpp
// Errors     one that is not there, or cannot be opened, is not open: 74 where a file is to be written there
// Threads    const: any

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/store/file_place.hpp"

namespace torquescope {

class OpenFolder {
 public:
  explicit OpenFolder(std::filesystem::path folder) : OpenFolder(std::move(folder), 0) {}
  ~OpenFolder();
  OpenFolder(OpenFolder const&) = delete;
  OpenFolder& operator=(OpenFolder const&) = delete;

  std::filesystem::path const& path() const { return path_; }
  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }      // below 0: not open
  int error_number() const { return error_number_; }  // why it is not open

  struct Listing {
    std::vector<std::string> names{};  // sorted
    int error_number = 0;              // not 0: they could not be read, or not all of them
  };
  Listing listing() const;
  std::vector<std::string> names() const { return listing().names; }
  // as openat(2), never through a link; below 0: not opened
  int open(std::string const& name, int flags, mode_t mode = 0) const;
  FilePlace place(std::string const& name) const;  // for what writes or reads a file, while the folder is open

 protected:
  OpenFolder(std::filesystem::path folder, int more_flags);

 private:
  std::filesystem::path path_;
  int descriptor_;
  int error_number_ = 0;
};

}  // namespace torquescope
