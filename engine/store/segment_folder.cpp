#include "engine/store/segment_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

#include "engine/store/disk_failure.hpp"
#include "engine/store/result_files.hpp"
#include "engine/store/temp_file.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

// failed: no folder is none
std::vector<fs::path> files_in(fs::path const& folder, std::error_code& failed) {
  std::vector<fs::path> names;
  fs::directory_iterator entry(folder, failed), end;
  if (failed == std::errc::interrupted) entry = fs::directory_iterator(folder, failed);
  for (; !failed && entry != end; entry.increment(failed)) names.push_back(entry->path());
  if (failed == std::errc::no_such_file_or_directory || failed == std::errc::not_a_directory) failed.clear();
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

// segments, and twins
bool is_kept_work(fs::path const& name) { return name.extension() == ".h5" || name.extension() == ".twins"; }

// on its way to be one of them
bool is_unfinished_work(fs::path const& name) {
  std::string const file = name.filename().string();
  std::size_t const end = file.rfind(".tmp.");
  return end != std::string::npos && is_kept_work(file.substr(0, end));
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
  int error_number = ::mkdir(folder.c_str(), anybody_as_umask_allows) == 0 || errno == EEXIST ? 0 : errno;
  // also when it was there: whoever made it may have been killed before its name was safe
  if (error_number == 0) error_number = sync_folder_of(folder);
  if (error_number != 0) throw cannot_write(folder, error_number);
}

SegmentNames::SegmentNames(fs::path folder, ShardChoice const& shard) : folder_(std::move(folder)), host_(host_name()) {
  auto const now = std::chrono::system_clock::now().time_since_epoch();
  begin_ = fmt::format("shard-{:04}-of-{:04}.{}.{}.{:x}", shard.index, shard.count, host_, ::getpid(),
                       std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

fs::path SegmentNames::next() { return folder_ / fmt::format("{}.{:06}.h5", begin_, number_++); }

std::vector<fs::path> segments_in(fs::path const& folder) {
  std::error_code failed;
  auto names = files_in(folder, failed);
  // to see none of them is not to have none
  if (failed) throw cannot_read(folder, failed.value());
  std::erase_if(names, [](fs::path const& name) { return name.extension() != ".h5"; });
  return names;
}

std::size_t twin_parts_in(fs::path const& folder) {
  std::error_code ignored;
  auto const names = files_in(folder, ignored);
  return static_cast<std::size_t>(
      std::count_if(names.begin(), names.end(), [](fs::path const& name) { return name.extension() == ".twins"; }));
}

void remove_segments(fs::path const& result) {
  fs::path const folder = segment_folder_of(result);
  std::error_code ignored;
  for (auto const& name : files_in(folder, ignored)) {
    if (is_kept_work(name))
      ::unlink(name.c_str());
    else if (name.extension() == ".lock" || is_unfinished_work(name))
      remove_if_abandoned(name);
  }
  ::rmdir(folder.c_str());
  remove_unfinished(result);
}

void remove_unfinished(fs::path const& result) {
  std::error_code ignored;
  fs::path const home = result.has_parent_path() ? result.parent_path() : fs::path(".");
  for (auto const& name : files_in(home, ignored))
    for (auto const& whole : {result, circumstances_file_of(result)})
      if (name.filename().string().starts_with(whole.filename().string() + ".tmp.")) remove_if_abandoned(name);
}

}  // namespace torquescope
