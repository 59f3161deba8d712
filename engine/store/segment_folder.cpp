#include "engine/store/segment_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/store/result_files.hpp"
#include "engine/store/temp_file.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(fs::path const& folder) {
  std::vector<fs::path> names;
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end; entry.increment(ignored))
    names.push_back(entry->path());
  std::sort(names.begin(), names.end());
  return names;
}

// a TempFile holds a lock on its file while it lives
bool has_a_writer(fs::path const& file) {
  int const descriptor = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) return true;
  bool const held = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0;
  ::close(descriptor);
  return held;
}

void remove_if_abandoned(fs::path const& file) {
  if (!has_a_writer(file)) ::unlink(file.c_str());
}

}  // namespace

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof(name) - 1) == 0 ? name : "unknown";
}

fs::path segment_folder_of(fs::path const& result) { return result.string() + ".parts"; }

void make_segment_folder(fs::path const& folder) {
  constexpr mode_t anybody_as_umask_allows = 0777;
  int error_number = 0;
  if (::mkdir(folder.c_str(), anybody_as_umask_allows) != 0) {
    if (errno == EEXIST) return;
    error_number = errno;
  } else {
    error_number = sync_folder_of(folder);
  }
  validate(error_number == 0, [&] {
    return Problem{.code = ExitCode::io,
                   .what = fmt::format("cannot make the folder {}: {}", folder.string(), std::strerror(error_number)),
                   .help = "write to a folder that is yours and has room, then run the same command again"};
  });
}

SegmentNames::SegmentNames(fs::path folder, ShardChoice const& shard) : folder_(std::move(folder)), host_(host_name()) {
  auto const now = std::chrono::system_clock::now().time_since_epoch();
  begin_ = fmt::format("shard-{:04}-of-{:04}.{}.{}.{:x}", shard.index, shard.count, host_, ::getpid(),
                       std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

fs::path SegmentNames::next() { return folder_ / fmt::format("{}.{:06}.h5", begin_, number_++); }

std::vector<fs::path> segments_in(fs::path const& folder) {
  auto names = files_in(folder);
  std::erase_if(names, [](fs::path const& name) { return name.extension() != ".h5"; });
  return names;
}

void remove_segments(fs::path const& result) {
  fs::path const folder = segment_folder_of(result);
  for (auto const& name : files_in(folder)) {
    if (name.extension() == ".h5")
      ::unlink(name.c_str());
    else if (name.filename().string().find(".h5.tmp.") != std::string::npos)
      remove_if_abandoned(name);
  }
  ::rmdir(folder.c_str());

  fs::path const home = result.has_parent_path() ? result.parent_path() : fs::path(".");
  for (auto const& name : files_in(home))
    for (auto const& whole : {result, circumstances_file_of(result)})
      if (name.filename().string().starts_with(whole.filename().string() + ".tmp.")) remove_if_abandoned(name);
}

}  // namespace torquescope
