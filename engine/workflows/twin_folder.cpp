#include "engine/workflows/twin_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/experiment/runs/code_identity.hpp"
#include "engine/simulate/twin_lanes.hpp"
#include "engine/store/disk_failure.hpp"
#include "engine/store/file_seal.hpp"

namespace torquescope {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// "this one is being computed": as long as its process lives, or has it
class Claim {
 public:
  Claim(OwnFolder const& folder, std::string file) : folder_(folder), file_(std::move(file)) {
    constexpr mode_t anybody_as_umask_allows = 0666;
    descriptor_ = folder_.open(file_, O_RDWR | O_CREAT | O_NONBLOCK, anybody_as_umask_allows);
    // without files or locks nobody waits for anybody
    is_ours_ = descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  }
  ~Claim() {
    if (descriptor_ < 0) return;
    // its name goes first: whoever gets the lock of a file without one finds the part published
    struct stat facts {};
    if (is_ours_ && ::fstat(descriptor_, &facts) == 0 && facts.st_size == 0) folder_.unlink(file_);
    ::close(descriptor_);
  }
  Claim(Claim const&) = delete;
  Claim& operator=(Claim const&) = delete;

  bool is_ours() const { return is_ours_; }

 private:
  OwnFolder const& folder_;
  std::string file_;
  int descriptor_ = -1;
  bool is_ours_ = false;
};

// a network file system asks its server again what the folder holds when somebody opens it, not before
void look_again(std::filesystem::path const& folder) {
  int const descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) ::close(descriptor);
}

}  // namespace

TwinFolder::TwinFolder(Setting setting)
    : setting_(std::move(setting)),
      folder_(segment_folder_of(setting_.result)),
      job_(job_identity(setting_.inputs_sha256, Keeps::work)),
      program_(numerics_sha256()) {}

void TwinFolder::warn(std::string const& text) const {
  if (setting_.tell) setting_.tell("warning", text);
}

std::string TwinFolder::account() const {
  return fmt::format("{} of {} parts of the replicates were simulated here", made_, made_ + taken_);
}

// what everybody else need not compute, were they two; the same answer in every process
bool TwinFolder::is_worth_it(TwinBatch const& batch) const {
  return batch.range.size() > twin_lanes &&
         0.5 * static_cast<double>(batch.range.size()) * static_cast<double>(batch.samples) >= setting_.least_gain;
}

// several parts for each process where there are replicates enough: one that is slower or late makes fewer
std::vector<TwinFolder::Part> TwinFolder::parts_of(TwinBatch const& batch) const {
  constexpr std::size_t most_for_each = 4, groups_to_divide = 8;
  std::size_t const groups = (batch.range.size() + twin_lanes - 1) / twin_lanes, shards = setting_.shard.count;
  std::size_t const n = std::min(groups, std::clamp(groups / groups_to_divide, shards, most_for_each * shards));
  std::vector<Part> parts;
  for (std::size_t i = 0; i < n; ++i) {
    Part part;
    part.range.from = batch.range.from + groups * i / n * twin_lanes;
    part.range.to = std::min(batch.range.to, batch.range.from + groups * (i + 1) / n * twin_lanes);
    part.file = folder_.path() / fmt::format("batch-{:04}.part-{:03}-of-{:03}.{:02x}.twins", batches_, i, n,
                                             fmt::join(std::span(job_).first(4), ""));
    Digest key;
    for (auto const& text : {std::string("twins 1"), setting_.inputs_sha256, program_, batch.identity,
                             fmt::format("{} {} {} {}", batches_, part.range.from, part.range.to, batch.numbers)})
      key.text(text);
    part.key = {job_, key.raw()};
    parts.push_back(std::move(part));
  }
  // our own share first
  std::size_t const first = setting_.shard.index * n / shards;
  std::rotate(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(first), parts.end());
  return parts;
}

void TwinFolder::fill(TwinBatch const& batch) {
  ++batches_;
  if (!is_worth_it(batch)) return batch.compute(batch.range);
  try {
    fill_parts(batch, parts_of(batch));
  } catch (Error const&) {
    // which replicate is told of must not depend on whose it was
    batch.compute(batch.range);
  }
}

void TwinFolder::fill_parts(TwinBatch const& batch, std::vector<Part> parts) {
  constexpr double least_patience_s = 10.0, times_as_slow = 10.0;
  auto since = Clock::now();
  while (!parts.empty()) {
    std::size_t const before = parts.size();
    std::erase_if(parts, [&](Part& part) { return take(batch, part) || claim_and_make(batch, part); });
    if (parts.empty()) return;
    if (parts.size() < before) {
      since = Clock::now();
      continue;
    }
    double const waited = seconds_since(since);
    if (waited > std::max(least_patience_s, times_as_slow * longest_part_s_)) {
      // alive, and yet it does not come: stopped, or cut off
      make(batch, parts.front());
      parts.erase(parts.begin());
      continue;
    }
    // seldom enough for a file server, and no more than a twentieth too late
    std::this_thread::sleep_for(std::chrono::duration<double>(std::clamp(0.05 * waited, 0.001, 0.1)));
    look_again(folder_.path());
  }
}

bool TwinFolder::take(TwinBatch const& batch, Part& part) {
  if (setting_.must_end && setting_.must_end()) throw TwinsAbandoned();
  numbers_.resize(part.range.size() * batch.numbers);
  if (!folder_.is_open()) return false;
  NumberFile const found = read_number_file(folder_.place(part.file.filename().string()), part.key, numbers_);
  if (found == NumberFile::damaged) {
    warn(fmt::format("{} is damaged; its replicates are simulated again", part.file.string()));
    folder_.unlink(part.file.filename().string());
  }
  if (found == NumberFile::foreign && !std::exchange(part.is_foreign, true))
    warn(fmt::format("{} is no part of this diagnosis: it stays as it is, and its replicates are not shared",
                     part.file.string()));
  if (found != NumberFile::whole) return false;
  for (std::size_t i = 0; i < part.range.size(); ++i)
    batch.put(part.range.from + i, std::span(numbers_).subspan(i * batch.numbers, batch.numbers));
  ++taken_;
  return true;
}

// false: another process is at it
bool TwinFolder::claim_and_make(TwinBatch const& batch, Part& part) {
  Claim const claim(folder_, part.file.filename().string() + ".lock");
  if (!claim.is_ours()) return false;
  // it may have been published since we looked
  if (!take(batch, part)) make(batch, part);
  return true;
}

void TwinFolder::make(TwinBatch const& batch, Part const& part) {
  auto const start = Clock::now();
  batch.compute(part.range);
  longest_part_s_ = std::max(longest_part_s_, seconds_since(start));
  ++made_;
  if (publishes_ && !part.is_foreign) publish(batch, part);
}

// without it nothing is wrong: others compute it as well
void TwinFolder::publish(TwinBatch const& batch, Part const& part) {
  numbers_.resize(part.range.size() * batch.numbers);
  for (std::size_t i = 0; i < part.range.size(); ++i)
    batch.get(part.range.from + i, std::span(numbers_).subspan(i * batch.numbers, batch.numbers));
  auto const free = free_bytes_for(part.file);
  publishes_ = !free || *free >= setting_.bytes_kept_free + number_file_bytes(numbers_.size());
  if (!publishes_) return warn("there is little room on the disk: replicates are no longer shared");
  try {
    write_number_file(folder_.place(part.file.filename().string()), part.key, numbers_);
  } catch (Error const& error) {
    publishes_ = false;
    warn(error.problems().front().what + "; replicates are no longer shared");
  }
}

}  // namespace torquescope
