#include "engine/store/segment_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/store/disk_failure.hpp"
#include "engine/store/file_seal.hpp"
#include "engine/store/own_folder.hpp"
#include "engine/store/result_files.hpp"
#include "engine/store/shard_lock.hpp"
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

bool are_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// "NAME.tmp.<pid>" or "NAME.tmp.<pid>.<number>", as TempFile makes them: what stands before; "" for any other name
std::string finished_name_of(std::string const& name) {
  std::size_t const end = name.rfind(".tmp.");
  if (end == std::string::npos) return "";
  std::string_view const rest = std::string_view(name).substr(end + 5);
  std::size_t const dot = rest.find('.');
  bool const is_ours =
      are_digits(rest.substr(0, dot)) && (dot == std::string_view::npos || are_digits(rest.substr(dot + 1)));
  return is_ours ? name.substr(0, end) : "";
}

bool is_segment(std::string const& name) { return name.ends_with(".h5"); }

// closed when it ends
class KeptFile {
 public:
  explicit KeptFile(int descriptor) : descriptor_(descriptor) {}
  ~KeptFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  KeptFile(KeptFile const&) = delete;
  KeptFile& operator=(KeptFile const&) = delete;

  bool is_regular() const {
    struct stat facts {};
    return descriptor_ >= 0 && ::fstat(descriptor_, &facts) == 0 && S_ISREG(facts.st_mode);
  }
  // a TempFile, and whoever holds a lock, holds it while its process lives
  bool has_a_writer() const { return ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0; }
  bool is_a_lock() const { return is_lock_file(descriptor_); }
  std::optional<Sha256> job() const { return sealed_identity(descriptor_); }

 private:
  int descriptor_;
};

constexpr int only_look = O_RDONLY | O_NONBLOCK;

// by what stands in the file: names prove nothing
bool is_of_job(OwnFolder const& folder, std::string const& name, Sha256 const& job) {
  KeptFile const file(folder.open(name, only_look));
  return job != Sha256{} && file.is_regular() && file.job() == job;
}

// nobody reads what a dead process was still writing, nor a lock that nobody holds
bool is_abandoned(OwnFolder const& folder, std::string const& name) {
  bool const is_lock = name.ends_with(".lock") && name.starts_with("shard-");
  std::string const finished = finished_name_of(name);
  bool const is_unfinished = is_segment(finished) && finished.starts_with("shard-");
  if (!is_lock && !is_unfinished) return false;
  KeptFile const file(folder.open(name, only_look));
  return file.is_regular() && !file.has_a_writer() && (!is_lock || file.is_a_lock());
}

}  // namespace

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof(name) - 1) == 0 ? name : "unknown";
}

std::vector<std::size_t> unfinished_shares(std::size_t runs, std::size_t shares,
                                           std::function<bool(std::size_t run)> const& is_done) {
  std::vector<std::size_t> unfinished;
  for (ShardChoice share{.index = 0, .count = shares}; share.index < shares; ++share.index) {
    std::size_t run = share.first(runs);
    while (run < share.end(runs) && is_done(run)) ++run;
    if (run < share.end(runs)) unfinished.push_back(share.index);
  }
  return unfinished;
}

fs::path segment_folder_of(fs::path const& result) { return result.string() + ".parts"; }

void make_segment_folder(fs::path const& folder) {
  constexpr mode_t anybody_as_umask_allows = 0777;
  bool const is_new = ::mkdir(folder.c_str(), anybody_as_umask_allows) == 0;
  int error_number = is_new || errno == EEXIST ? 0 : errno;
  if (error_number == 0 && !is_new) refuse_foreign_folder(folder);
  // also when it was there: whoever made it may have been killed before its name was safe
  if (error_number == 0) error_number = sync_folder_of(folder);
  if (error_number != 0) throw cannot_write(folder, error_number);
}

void refuse_foreign_folder(fs::path const& folder) { OwnFolder const refuses(folder); }

SegmentNames::SegmentNames(fs::path folder, ShardChoice const& shard) : folder_(std::move(folder)), host_(host_name()) {
  auto const now = std::chrono::system_clock::now().time_since_epoch();
  begin_ = fmt::format("shard-{:04}-of-{:04}.{}.{}.{:x}", shard.index, shard.count, host_, ::getpid(),
                       std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

fs::path SegmentNames::next() { return folder_ / fmt::format("{}.{:06}.h5", begin_, number_++); }

std::vector<FilePlace> segments_in(OpenFolder const& folder) {
  auto const found = folder.listing();
  // to see none of them is not to have none
  bool const is_absent = found.error_number == ENOENT || found.error_number == ENOTDIR;
  if (found.error_number != 0 && !is_absent) throw cannot_read(folder.path(), found.error_number);
  std::vector<FilePlace> segments;
  for (auto const& name : found.names)
    if (is_segment(name)) segments.push_back(folder.place(name));
  return segments;
}

std::vector<std::string> remove_segments(fs::path const& result, std::string const& inputs_sha256) {
  remove_unfinished(result);
  std::vector<std::string> left;
  fs::path const path = segment_folder_of(result);
  try {
    OwnFolder const folder(path);
    Sha256 const job = job_identity(inputs_sha256, Keeps::work);
    for (auto const& name : folder.names()) {
      bool const is_ours = is_segment(name) ? is_of_job(folder, name, job) : is_abandoned(folder, name);
      if (is_ours)
        folder.unlink(name);
      else if (is_segment(name))
        left.push_back(name);
    }
  } catch (Error const& refused) {
    return {refused.problems().front().what + ": nothing in it was touched"};
  }
  ::rmdir(path.c_str());
  if (left.empty()) return {};
  constexpr std::size_t most_names = 3;
  std::size_t const n = left.size();
  bool const cut = n > most_names;
  if (cut) left.resize(most_names);
  return {fmt::format("{} of the files in {} {} not, or not verifiably, of this job and {} left there: {}{}", n,
                      path.string(), n == 1 ? "is" : "are", n == 1 ? "was" : "were", fmt::join(left, ", "),
                      cut ? ", ..." : "")};
}

void remove_unfinished(fs::path const& result) {
  fs::path const home = result.has_parent_path() ? result.parent_path() : fs::path(".");
  std::error_code ignored;
  for (auto const& name : files_in(home, ignored)) {
    std::string const finished = finished_name_of(name.filename().string());
    if (finished != result.filename() && finished != circumstances_file_of(result).filename()) continue;
    KeptFile const file(::open(name.c_str(), only_look | O_NOFOLLOW | O_CLOEXEC));
    if (file.is_regular() && !file.has_a_writer()) ::unlink(name.c_str());
  }
}

}  // namespace torquescope
