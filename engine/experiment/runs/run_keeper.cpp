#include "engine/experiment/runs/run_keeper.hpp"

#include <time.h>  // NOLINT(modernize-deprecated-headers): clock_gettime is POSIX, <ctime> does not promise it

#include <algorithm>
#include <iterator>

#include "engine/base/contract.hpp"
#include "engine/experiment/runs/provenance_writer.hpp"
#include "engine/store/own_folder.hpp"

namespace torquescope {
namespace {

constexpr double share_of_time = 0.01;
constexpr double share_not_kept = 0.1;
constexpr double most_intervals = 15.0;

std::int64_t nanoseconds(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

}  // namespace

// a few milliseconds late, and a fifth of the price
std::int64_t RunKeeper::now_ns() const {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

RunKeeper::RunKeeper(Setting setting, std::mutex& hdf5)
    : setting_(std::move(setting)),
      hdf5_(hdf5),
      start_ns_(now_ns()),
      next_ns_(start_ns_ + nanoseconds(setting_.interval_s)),
      names_(setting_.folder, setting_.shard),
      pile_(setting_.most_bytes) {}

double RunKeeper::share_of_first_interval() const {
  return static_cast<double>(now_ns() - start_ns_) * 1e-9 / setting_.interval_s;
}

void RunKeeper::begin_estimator(std::string const& label, std::string const& search_sha256, HistoryShape const& shape,
                                std::map<std::size_t, std::size_t> const& already_safe) {
  std::lock_guard const lock(guard_);
  estimators_.push_back({label, search_sha256, shape});
  for (auto const& [run, generations] : already_safe) safe_[{estimators_.size() - 1, run}] = generations;
}

void RunKeeper::begin(std::size_t run) {
  std::lock_guard const lock(guard_);
  under_way_[{estimators_.size() - 1, run}] = interval_.load();
}

void RunKeeper::advance(std::int64_t now) {
  std::lock_guard const lock(guard_);
  if (now < next_ns_.load()) return;  // another thread was faster
  interval_.fetch_add(1);
  double const so_far_s = static_cast<double>(now - start_ns_) * 1e-9;
  double const wait_s = std::clamp(share_of_time * so_far_s, setting_.interval_s, most_intervals * setting_.interval_s);
  next_ns_.store(now + nanoseconds(wait_s));
}

std::uint64_t RunKeeper::due() {
  std::int64_t const now = now_ns();
  if (now >= next_ns_.load(std::memory_order_relaxed)) advance(now);
  return interval_.load(std::memory_order_relaxed);
}

std::size_t RunKeeper::bytes_of(RunId id) const {
  auto const& shape = estimators_[id.first].shape;
  auto const pending = pending_.find(id);
  std::size_t const generations = pending->second.whole ? pending->second.whole->told : pending->second.part.count;
  return generations * (shape.members * (shape.parameters + 1) + 8) * sizeof(double);
}

void RunKeeper::put(RunId id, Pending pending, std::unique_lock<std::mutex>& lock) {
  if (pending_.contains(id)) pending_bytes_ -= bytes_of(id);
  pending_[id] = std::move(pending);
  pending_bytes_ += bytes_of(id);

  std::uint64_t const interval = interval_.load();
  bool const everything = setting_.everything || interval > 0 || share_of_first_interval() > 0.5;
  bool const time_to_write = interval > written_interval_ && all_handed_over();
  if (time_to_write || (everything && pending_bytes_ > setting_.most_bytes))
    write(lock);
  else if (!everything)
    let_go_of_some(setting_.most_bytes / 2);
}

bool RunKeeper::all_handed_over() const {
  std::uint64_t const interval = interval_.load();
  return std::all_of(under_way_.begin(), under_way_.end(), [&](auto const& run) { return run.second >= interval; });
}

// of runs that have ended the oldest first, and half of it, so that this is seldom; what is under way is handed over
// for an interval's end or a stop only, and stays
void RunKeeper::let_go_of_some(std::size_t most_bytes) {
  if (pending_bytes_ <= most_bytes) return;
  for (auto run = pending_.begin(); run != pending_.end() && pending_bytes_ > most_bytes / 2;) {
    if (run->second.whole) pending_bytes_ -= bytes_of(run->first);
    run = run->second.whole ? pending_.erase(run) : std::next(run);
  }
}

void RunKeeper::keep(std::size_t run, RunSoFar const& so_far) {
  std::unique_lock lock(guard_);
  RunId const id{estimators_.size() - 1, run};
  under_way_[id] = interval_.load();
  std::size_t const safe = safe_[id];
  if (so_far.generations <= safe) return;
  HistoryShape const shape = estimators_[id.first].shape;
  lock.unlock();
  RunPart part = part_of(so_far.history, shape, run, safe, so_far.generations);
  part.state = so_far.state();
  lock.lock();
  put(id, {std::move(part), nullptr}, lock);
}

void RunKeeper::ended(std::size_t run, std::shared_ptr<RunHistory const> history) {
  std::unique_lock lock(guard_);
  RunId const id{estimators_.size() - 1, run};
  under_way_.erase(id);
  bool const early = interval_.load() == 0 && share_of_first_interval() < share_not_kept;
  if (early && !setting_.everything) return;
  put(id, {{}, std::move(history)}, lock);
}

void RunKeeper::write_all() {
  std::unique_lock lock(guard_);
  if (!pending_.empty()) write(lock);
}

// the lock is given up while the disk works: other runs go on
void RunKeeper::write(std::unique_lock<std::mutex>& lock) {
  auto const pending = std::exchange(pending_, {});
  pending_bytes_ = 0;
  written_interval_ = interval_.load();
  std::vector<EstimatorParts> estimators;
  for (auto const& estimator : estimators_)
    estimators.push_back({estimator.label, estimator.search_sha256, estimator.shape, {}});
  std::map<RunId, std::size_t> const safe = safe_;
  auto const name = names_.next();
  SegmentOrigin origin = setting_.origin;
  lock.unlock();

  std::size_t ended = 0;
  std::vector<std::pair<RunId, std::size_t>> ends;
  for (auto const& [id, run] : pending) {
    auto& estimator = estimators[id.first];
    if (run.whole) {
      auto const known = safe.find(id);
      std::size_t const first = known == safe.end() ? 0 : known->second;
      RunPart part{.run = id.second, .first = first, .count = run.whole->told - first, .ended = true};
      part.state = run.whole->last_state;
      part.whole = run.whole;
      estimator.parts.push_back(std::move(part));
      ++ended;
    } else {
      estimator.parts.push_back(run.part);
    }
    ends.emplace_back(id, estimator.parts.back().end());
  }
  std::erase_if(estimators, [](EstimatorParts const& estimator) { return estimator.parts.empty(); });
  origin.host = names_.host();
  origin.written = utc_now();
  {
    std::lock_guard const alone(hdf5_);
    // a process that finished may have tidied up behind us
    make_segment_folder(setting_.folder);
    OwnFolder const folder(setting_.folder);
    write_segment(folder.place(name.filename().string()), origin, estimators);
    pile_.add(name, origin, [&] {
      std::lock_guard const names(guard_);
      return names_.next();
    });
  }

  lock.lock();
  for (auto const& [id, end] : ends) safe_[id] = std::max(safe_[id], end);
  runs_safe_ += ended;
  ++segments_;
  if (setting_.safe) setting_.safe(runs_safe_);
}

std::size_t RunKeeper::runs_safe() const {
  std::lock_guard const lock(guard_);
  return runs_safe_;
}

std::size_t RunKeeper::segments_written() const {
  std::lock_guard const lock(guard_);
  return segments_;
}

}  // namespace torquescope
