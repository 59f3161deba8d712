#include "engine/store/shard_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <string>
#include <utility>

#include "engine/base/error.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

// what a signal handler needs to take a lock away: memory that lives as long as the process
struct LockInHand {
  std::atomic<bool> is_held{false};
  int folder = -1;
  char folder_name[PATH_MAX] = {}, file_name[NAME_MAX + 1] = {};
};
LockInHand in_hand;
static_assert(std::atomic<bool>::is_always_lock_free);

void take_in_hand(OwnFolder const& folder, std::string const& file) {
  in_hand.is_held.store(false);
  std::string const& path = folder.path().native();
  if (path.size() >= sizeof in_hand.folder_name || file.size() >= sizeof in_hand.file_name) return;
  in_hand.folder = folder.descriptor();
  in_hand.folder_name[path.copy(in_hand.folder_name, path.size())] = '\0';
  in_hand.file_name[file.copy(in_hand.file_name, file.size())] = '\0';
  in_hand.is_held.store(true);
}

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

// a disk that fails is told of by those who must write
fs::path made(fs::path folder) {
  constexpr mode_t as_umask_allows = 0777;
  static_cast<void>(::mkdir(folder.c_str(), as_umask_allows));
  return folder;
}

std::string words_in(int descriptor) {
  char text[1000] = {};
  ssize_t const size = ::pread(descriptor, text, sizeof(text) - 1, 0);
  return size > 0 ? std::string(text, static_cast<std::size_t>(size)) : "a process that does not say its name";
}

std::string first_line(std::string const& words) { return words.substr(0, words.find('\n')); }

bool is_lock_name(std::string const& name) { return name.starts_with("shard-") && name.ends_with(".lock"); }

}  // namespace

bool is_lock_file(int descriptor) {
  struct stat facts {};
  if (::fstat(descriptor, &facts) != 0 || !S_ISREG(facts.st_mode)) return false;
  std::string const words = lock_words, zeros(words.size(), '\0');
  std::string begin = zeros;
  ssize_t const got = ::pread(descriptor, begin.data(), begin.size(), 0);
  if (got < 0) return false;
  auto const size = static_cast<std::size_t>(got);
  return begin.compare(0, size, words, 0, size) == 0 || begin == zeros;
}

ShardLock::ShardLock(fs::path const& result, ShardChoice const& shard)
    : folder_(made(segment_folder_of(result))),
      file_(fmt::format("shard-{:04}-of-{:04}.lock", shard.index, shard.count)) {
  constexpr mode_t as_umask_allows = 0666;
  descriptor_ = folder_.open(file_, O_RDWR | O_CREAT | O_NONBLOCK, as_umask_allows);
  if (descriptor_ < 0) return;
  if (!is_lock_file(descriptor_)) {
    ::close(std::exchange(descriptor_, -1));
    return;
  }
  Held const held = take(descriptor_);
  if (held == Held::by_another) {
    std::string const who = first_line(words_in(descriptor_));
    ::close(descriptor_);
    throw Error(Problem{
        .code = ExitCode::exists,
        .what = fmt::format("{} of {} is at work already: {}",
                            shard.count > 1 ? fmt::format("shard {}/{}", shard.index, shard.count) : "the job",
                            result.string(), who),
        .help = fmt::format("wait for it, or stop it; torquescope status {} says how far it is", result.string())});
  }
  // a hint for people: nobody reads it but the message above and `status`
  who_ = fmt::format("{}{} on {}", lock_words, ::getpid(), host_name());
  say("");
  take_in_hand(folder_, file_);
}

void ShardLock::say(std::string const& text) const {
  if (descriptor_ < 0) return;
  std::string const words = text.empty() ? who_ : who_ + "\n" + text;
  // its length last: who looks in between sees the end of what was said before, and never half a name
  [[maybe_unused]] bool const said = ::pwrite(descriptor_, words.data(), words.size(), 0) > 0 &&
                                     ::ftruncate(descriptor_, static_cast<off_t>(words.size())) == 0;
}

std::vector<LockWords> locks_in(fs::path const& segment_folder) {
  std::vector<LockWords> found;
  std::error_code ignored;
  if (fs::is_symlink(segment_folder, ignored)) return found;
  OwnFolder const folder(segment_folder);
  for (auto const& name : folder.names()) {
    if (!is_lock_name(name)) continue;
    int const descriptor = folder.open(name, O_RDONLY | O_NONBLOCK);
    if (descriptor < 0) continue;
    if (is_lock_file(descriptor)) {
      std::string const words = words_in(descriptor);
      std::size_t const end = std::min(words.find('\n'), words.size());
      bool const is_held = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
      found.push_back({words.substr(0, end), end < words.size() ? words.substr(end + 1) : "", is_held});
    }
    ::close(descriptor);
  }
  return found;
}

void drop_held_lock() noexcept {
  if (!in_hand.is_held.exchange(false)) return;
  ::unlinkat(in_hand.folder, in_hand.file_name, 0);
  ::rmdir(in_hand.folder_name);
}

ShardLock::~ShardLock() {
  if (in_hand.folder == folder_.descriptor()) in_hand.is_held.store(false);
  if (descriptor_ >= 0) {
    folder_.unlink(file_);
    ::close(descriptor_);
  }
  ::rmdir(folder_.path().c_str());
}

}  // namespace torquescope
