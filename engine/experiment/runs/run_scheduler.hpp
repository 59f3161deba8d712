#pragma once
// Spreads independent runs over threads without a barrier and hands their results over in the order of the runs. A task
// is a group of neighbouring runs that go side by side on one thread.
//
// Threads    run(first, count, team) is called from any thread, each index being in one group; `team` threads are its
//            own to split a population with; commit(index, result) is called by one thread at a time, index = 0, 1, 2,
//            ...
// Errors     the first exception of a group ends the spreading and is rethrown after the running ones have ended

#include <algorithm>
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

// groups of at most `most` runs: as many for each thread, so that none waits while another one has two left
inline std::size_t group_count(std::size_t runs, int threads, std::size_t most) {
  if (most <= 1) return runs;
  std::size_t const at_once = static_cast<std::size_t>(threads) * most;
  std::size_t const rounds = (runs + at_once - 1) / at_once;
  return std::min(runs, rounds * static_cast<std::size_t>(threads));
}

// run returns a vector with one result per run of its group
template <class Run, class Commit>
void schedule_runs(std::size_t runs, int threads, std::size_t most_per_group, Run&& run, Commit&& commit) {
  using Results = decltype(run(std::size_t{}, std::size_t{}, int{}));
  std::mutex guard;
  std::map<std::size_t, Results> waiting;  // by first run: finished before their predecessors
  std::size_t next = 0;
  int const team = team_size(runs, threads);
  std::size_t const groups = group_count(runs, threads, most_per_group);
  parallel_for(groups, threads, [&](std::size_t group, int) {
    // sizes differ by one at most
    std::size_t const first = group * runs / groups;
    Results results = run(first, (group + 1) * runs / groups - first, team);
    std::lock_guard const lock(guard);
    waiting.emplace(first, std::move(results));
    for (auto ready = waiting.find(next); ready != waiting.end(); ready = waiting.find(next)) {
      for (auto& result : ready->second) commit(next++, std::move(result));
      waiting.erase(ready);
    }
  });
}

}  // namespace torquescope
