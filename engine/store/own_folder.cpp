#include "engine/store/own_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/base/interrupted_call.hpp"
#include "engine/store/disk_failure.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

Error refused(fs::path const& folder, std::string const& what, std::string const& cure) {
  return Error(Problem{.code = ExitCode::exists,
                       .what = fmt::format("{} {}", folder.string(), what),
                       .notes = {"what a job has done so far is kept in a folder of its own, and removed from there"},
                       .help = cure + ", or --out another name"});
}

// who owns what this process makes beside a folder: not always the process's user
std::optional<uid_t> owner_of_new_files(fs::path const& beside) {
  std::string const name = fmt::format("{}.tmp.{}", beside.string(), ::getpid());
  constexpr mode_t mine_alone = 0600;
  int const descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mine_alone);
  if (descriptor < 0) return std::nullopt;
  struct stat facts {};
  bool const known = ::fstat(descriptor, &facts) == 0;
  ::unlink(name.c_str());
  ::close(descriptor);
  return known ? std::optional(facts.st_uid) : std::nullopt;
}

}  // namespace

OwnFolder::OwnFolder(fs::path folder)
    : path_(std::move(folder)),
      descriptor_(
          unless_interrupted([&] { return ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC); })) {
  struct stat facts {};
  if (descriptor_ < 0) {
    error_number_ = errno;
    if (::lstat(path_.c_str(), &facts) != 0 || S_ISDIR(facts.st_mode)) return;
    bool const is_link = S_ISLNK(facts.st_mode);
    throw refused(path_, is_link ? "is a symbolic link" : "is not a folder",
                  (is_link ? "remove the link: rm " : "move it away: mv ") + path_.string());
  }
  if (::fstat(descriptor_, &facts) != 0 || facts.st_uid == ::geteuid() || owner_of_new_files(path_) == facts.st_uid)
    return;
  ::close(descriptor_);
  throw refused(path_, fmt::format("belongs to another user (uid {})", facts.st_uid), "ask its owner to remove it");
}

OwnFolder::~OwnFolder() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::vector<std::string> OwnFolder::names() const {
  std::vector<std::string> names;
  // of its own: reading moves the position that all copies of a descriptor share
  int const again = is_open() ? ::openat(descriptor_, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
  DIR* const listing = again >= 0 ? ::fdopendir(again) : nullptr;
  if (listing == nullptr) {
    if (again >= 0) ::close(again);
    return names;
  }
  while (dirent const* const entry = ::readdir(listing)) {
    std::string const name = entry->d_name;
    if (name != "." && name != "..") names.push_back(name);
  }
  ::closedir(listing);
  std::sort(names.begin(), names.end());
  return names;
}

int OwnFolder::open(std::string const& name, int flags, mode_t mode) const {
  if (!is_open()) return -1;
  return unless_interrupted([&] { return ::openat(descriptor_, name.c_str(), flags | O_NOFOLLOW | O_CLOEXEC, mode); });
}

bool OwnFolder::unlink(std::string const& name) const {
  return is_open() && ::unlinkat(descriptor_, name.c_str(), 0) == 0;
}

FilePlace OwnFolder::place(std::string const& name) const {
  if (!is_open()) throw cannot_write(path_ / name, error_number_);
  return {path_ / name, descriptor_, name};
}

}  // namespace torquescope
