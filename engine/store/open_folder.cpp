#include "engine/store/open_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "engine/base/interrupted_call.hpp"
#include "engine/store/disk_failure.hpp"

namespace torquescope {

OpenFolder::OpenFolder(std::filesystem::path folder, int more_flags)
    : path_(std::move(folder)),
      descriptor_(
          unless_interrupted([&] { return ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | more_flags); })) {
  if (descriptor_ < 0) error_number_ = errno;
}

OpenFolder::~OpenFolder() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

OpenFolder::Listing OpenFolder::listing() const {
  Listing found;
  if (!is_open()) return {{}, error_number_};
  // of its own: reading moves the position that all copies of a descriptor share
  int const again = unless_interrupted([&] { return ::openat(descriptor_, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  DIR* const entries = again >= 0 ? ::fdopendir(again) : nullptr;
  if (entries == nullptr) {
    found.error_number = errno;
    if (again >= 0) ::close(again);
    return found;
  }
  // where it fails and where it ends, readdir says the same, but for errno
  errno = 0;
  while (dirent const* const entry = ::readdir(entries)) {
    std::string const name = entry->d_name;
    if (name != "." && name != "..") found.names.push_back(name);
    errno = 0;
  }
  found.error_number = errno;
  ::closedir(entries);
  std::sort(found.names.begin(), found.names.end());
  return found;
}

int OpenFolder::open(std::string const& name, int flags, mode_t mode) const {
  if (!is_open()) return -1;
  return unless_interrupted([&] { return ::openat(descriptor_, name.c_str(), flags | O_NOFOLLOW | O_CLOEXEC, mode); });
}

FilePlace OpenFolder::place(std::string const& name) const {
  if (!is_open()) throw cannot_write(path_ / name, error_number_);
  return {path_ / name, descriptor_, name};
}

}  // namespace torquescope
