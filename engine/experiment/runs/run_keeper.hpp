#pragma once
// Keeps what runs have done so far, and writes it into segments now and then, so that a killed job goes on from there.
//
// Pace       a segment at most every `interval_s` (1 % of the time so far if that is longer, but no more than fifteen
//            intervals), when every run under way has handed over what it has; jobs that are shorter write none. More
//            than `most_bytes` waiting is written at once
// First      what ends in its first tenth of an interval is not kept, and until its middle only half of `most_bytes`
//            is: repeating two seconds costs less than memory of every short job. With `everything` all is kept
// Number     segments of this process are gathered as they become many (segment_pile.hpp)
// Threads    any; runs hand over in the thread they run in, and one of these writes. `hdf5` is held while it does:
//            whoever else uses HDF5 meanwhile must hold it too
// Errors     74 from the thread that writes: nothing published is damaged, what was kept before is safe

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "engine/experiment/runs/segment_file.hpp"
#include "engine/experiment/runs/segment_pile.hpp"

namespace torquescope {

class RunKeeper {
 public:
  struct Setting {
    std::filesystem::path folder;  // made when the first segment is written
    SegmentOrigin origin;
    ShardChoice shard{};
    double interval_s = 20.0;
    std::size_t most_bytes = std::size_t{64} << 20;
    bool everything = false;  // of a shard, whose segments are all that it leaves
    // told by the thread that wrote a segment, once it is safe: runs that ended and were written by this process
    std::function<void(std::size_t runs_safe)> safe{};
  };
  RunKeeper(Setting setting, std::mutex& hdf5);

  // of the runs that follow, until the next call; already_safe: generations that segments have, by run
  void begin_estimator(std::string const& label, std::string const& search_sha256, HistoryShape const& shape,
                       std::map<std::size_t, std::size_t> const& already_safe);

  // between begin() and ended() a run is waited for before a segment is written
  void begin(std::size_t run);
  // a number that grows when it is time to hand over; cheap enough to be asked after every generation
  std::uint64_t due();
  void keep(std::size_t run, RunSoFar const& so_far);
  void ended(std::size_t run, std::shared_ptr<RunHistory const> history);

  // everything handed over and not yet written; runs under way must have handed over
  void write_all();

  std::size_t runs_safe() const;  // that ended and were written by this process
  std::size_t segments_written() const;

 private:
  using RunId = std::pair<std::size_t, std::size_t>;  // estimator, run
  struct Pending {
    RunPart part{};                             // of a run under way
    std::shared_ptr<RunHistory const> whole{};  // of one that has ended
  };
  struct Estimator {
    std::string label, search_sha256;
    HistoryShape shape;
  };

  std::int64_t now_ns() const;
  double share_of_first_interval() const;
  void advance(std::int64_t now);
  bool all_handed_over() const;
  void put(RunId id, Pending pending, std::unique_lock<std::mutex>& lock);
  void write(std::unique_lock<std::mutex>& lock);
  void let_go_of_some(std::size_t most_bytes);
  std::size_t bytes_of(RunId id) const;

  Setting setting_;
  std::mutex& hdf5_;
  std::int64_t start_ns_;
  std::atomic<std::int64_t> next_ns_;
  std::atomic<std::uint64_t> interval_{0};

  mutable std::mutex guard_;  // of what follows
  SegmentNames names_;
  std::vector<Estimator> estimators_;
  std::map<RunId, std::uint64_t> under_way_;  // and the interval in which each handed over last
  std::map<RunId, Pending> pending_;
  std::size_t pending_bytes_ = 0;
  std::map<RunId, std::size_t> safe_;  // generations that segments have
  std::uint64_t written_interval_ = 0;
  std::size_t runs_safe_ = 0, segments_ = 0;
  SegmentPile pile_;  // of `hdf5`
};

}  // namespace torquescope
