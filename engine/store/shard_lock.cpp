#include "engine/store/shard_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "engine/base/error.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

enum class Held { by_us, by_another, by_nobody };

// whoever tidies up looks at a lock for a moment, and a process that was killed may need one to be gone
Held take(int descriptor) {
  constexpr int attempts = 5;
  constexpr useconds_t pause_us = 50'000;
  for (int i = 0; i < attempts; ++i) {
    if (i > 0) ::usleep(pause_us);
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return Held::by_us;
    if (errno != EWOULDBLOCK && errno != EINTR) return Held::by_nobody;
  }
  return Held::by_another;
}

std::string words_in(int descriptor) {
  char text[300] = {};
  ssize_t const size = ::pread(descriptor, text, sizeof(text) - 1, 0);
  return size > 0 ? std::string(text, static_cast<std::size_t>(size)) : "a process that does not say its name";
}

}  // namespace

ShardLock::ShardLock(fs::path const& result, ShardChoice const& shard) {
  fs::path const folder = segment_folder_of(result);
  file_ = folder / fmt::format("shard-{:04}-of-{:04}.lock", shard.index, shard.count);
  // a disk that fails is told of by those who must write
  constexpr mode_t folder_as_umask_allows = 0777, file_as_umask_allows = 0666;
  static_cast<void>(::mkdir(folder.c_str(), folder_as_umask_allows));
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, file_as_umask_allows);
  if (descriptor_ < 0) return;
  Held const held = take(descriptor_);
  if (held == Held::by_another) {
    std::string const who = words_in(descriptor_);
    ::close(descriptor_);
    throw Error(Problem{
        .code = ExitCode::exists,
        .what = fmt::format("{} of {} is at work already: {}",
                            shard.count > 1 ? fmt::format("shard {}/{}", shard.index, shard.count) : "the job",
                            result.string(), who),
        .help = fmt::format("wait for it, or stop it; torquescope status {} says how far it is", result.string())});
  }
  // a hint for people: nobody reads it but the message above
  std::string const who = fmt::format("process {} on {}", ::getpid(), host_name());
  [[maybe_unused]] bool const said =
      ::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, who.data(), who.size(), 0) > 0;
}

ShardLock::~ShardLock() {
  if (descriptor_ >= 0) {
    ::unlink(file_.c_str());
    ::close(descriptor_);
  }
  ::rmdir(file_.parent_path().c_str());
}

}  // namespace torquescope
