#pragma once
// Spreads independent runs over threads without a barrier and hands their results over in the order of the runs.
//
// Threads    run(index, team) is called from any thread, at most once per index, `team` threads being its own to split a
//            population with; commit(index, result) is called by one thread at a time, index = 0, 1, 2, ...
// Errors     the first exception of a run ends the spreading and is rethrown after the running ones have ended

#include <cstddef>
#include <map>
#include <mutex>
#include <utility>

#include "engine/base/parallel.hpp"

namespace torquescope {

// threads a run may use for its own population: more than one only when there are fewer runs than threads
inline int team_size(std::size_t runs, int threads) {
  return runs == 0 || runs >= static_cast<std::size_t>(threads) ? 1 : threads / static_cast<int>(runs);
}

template <class Run, class Commit>
void schedule_runs(std::size_t runs, int threads, Run&& run, Commit&& commit) {
  using Result = decltype(run(std::size_t{}, int{}));
  std::mutex guard;
  std::map<std::size_t, Result> waiting;  // finished before their predecessors
  std::size_t next = 0;
  int const team = team_size(runs, threads);
  parallel_for(runs, threads, [&](std::size_t index, int) {
    Result result = run(index, team);
    std::lock_guard const lock(guard);
    waiting.emplace(index, std::move(result));
    for (auto ready = waiting.find(next); ready != waiting.end(); ready = waiting.find(next)) {
      commit(next, std::move(ready->second));
      waiting.erase(ready);
      ++next;
    }
  });
}

}  // namespace torquescope
