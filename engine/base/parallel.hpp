#pragma once
// The only place with OpenMP pragmas: independent tasks over threads, no barrier but the end.
//
// Errors     an exception inside a task does not cross the OpenMP region: the first one (by task index) is rethrown
//            after all running tasks have ended; tasks not yet begun are skipped. Stopped, within a Stoppable.
//            std::bad_alloc where threads do not start
// Threads    task(index, thread) runs at most once per index; thread < thread_count

#include <cstddef>
#include <exception>
#include <functional>
#include <string>

namespace torquescope {

struct ThreadChoice {
  int count = 1;
  std::string reason;     // "--threads", "OMP_NUM_THREADS", "SLURM_CPUS_PER_TASK", "affinity mask"
  std::string warning{};  // not empty when a request was clamped to the affinity mask
};

// --threads (0: not given), then OMP_NUM_THREADS, SLURM_CPUS_PER_TASK, then the affinity mask and cgroup quota;
// always clamped to the mask. Never std::thread::hardware_concurrency(): it ignores taskset.
ThreadChoice choose_threads(int requested);

// Somebody asked the work to end. No Error: a search tries models and goes on without those that fail
class Stopped : public std::exception {
 public:
  char const* what() const noexcept override { return "stopped"; }
};

// While one lives, every task that this thread begins by parallel_for(), and those that these begin, is preceded by the
// question; true: Stopped. The question is asked from any thread, and outlives this
class Stoppable {
 public:
  explicit Stoppable(std::function<bool()> const& must_stop);
  ~Stoppable();
  Stoppable(Stoppable const&) = delete;
  Stoppable& operator=(Stoppable const&) = delete;

 private:
  std::function<bool()> const* before_;
};

// calls task(index, thread) for index = 0 .. n-1; tasks are handed out in order, one at a time
void parallel_for(std::size_t n, int threads, std::function<void(std::size_t index, int thread)> const& task);

}  // namespace torquescope
