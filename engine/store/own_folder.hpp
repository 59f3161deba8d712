#pragma once
// A folder that this program made for its own files, opened once (open_folder.hpp).
//
// Refused    a symbolic link, what is no folder, and a folder of another user: what lies there may be anybody's. (Where
//            the file system gives new files another owner than this user, as some network mounts do, that owner is us)
// Errors     73 for what is refused; a folder that is not there, or cannot be opened, is not open
// Threads    const: any

#include <filesystem>
#include <string>

#include "engine/store/open_folder.hpp"

namespace torquescope {

class OwnFolder : public OpenFolder {
 public:
  explicit OwnFolder(std::filesystem::path folder);

  bool unlink(std::string const& name) const;
};

}  // namespace torquescope
