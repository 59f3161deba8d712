#pragma once
// A folder that this program made for its own files, opened once: what is done in it is done in that very folder,
// whatever its name leads to meanwhile.
//
// Refused    a symbolic link, what is no folder, and a folder of another user: what lies there may be anybody's. (Where
//            the file system gives new files another owner than this user, as some network mounts do, that owner is us)
// Errors     73 for what is refused; a folder that is not there, or cannot be opened, is not open: 74 where a file is
//            to be written there
// Threads    const: any

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/store/file_place.hpp"

namespace torquescope {

class OwnFolder {
 public:
  explicit OwnFolder(std::filesystem::path folder);
  ~OwnFolder();
  OwnFolder(OwnFolder const&) = delete;
  OwnFolder& operator=(OwnFolder const&) = delete;

  std::filesystem::path const& path() const { return path_; }
  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }  // below 0: not open

  std::vector<std::string> names() const;  // sorted; none when they cannot be read
  // as openat(2), never through a link; below 0: not opened
  int open(std::string const& name, int flags, mode_t mode = 0) const;
  bool unlink(std::string const& name) const;
  FilePlace place(std::string const& name) const;  // for what writes a file (temp_file.hpp), while the folder is open

 private:
  std::filesystem::path path_;
  int descriptor_;
  int error_number_ = 0;  // why it is not open
};

}  // namespace torquescope
