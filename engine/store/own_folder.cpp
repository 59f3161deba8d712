#include "engine/store/own_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <optional>
#include <utility>

#include "engine/base/error.hpp"

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

OwnFolder::OwnFolder(fs::path folder) : OpenFolder(std::move(folder), O_NOFOLLOW) {
  struct stat facts {};
  if (!is_open()) {
    if (::lstat(path().c_str(), &facts) != 0 || S_ISDIR(facts.st_mode)) return;
    bool const is_link = S_ISLNK(facts.st_mode);
    throw refused(path(), is_link ? "is a symbolic link" : "is not a folder",
                  (is_link ? "remove the link: rm " : "move it away: mv ") + path().string());
  }
  if (::fstat(descriptor(), &facts) != 0 || facts.st_uid == ::geteuid() || owner_of_new_files(path()) == facts.st_uid)
    return;
  throw refused(path(), fmt::format("belongs to another user (uid {})", facts.st_uid), "ask its owner to remove it");
}

bool OwnFolder::unlink(std::string const& name) const {
  return is_open() && ::unlinkat(descriptor(), name.c_str(), 0) == 0;
}

}  // namespace torquescope
