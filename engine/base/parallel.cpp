#include "engine/base/parallel.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <limits>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

namespace torquescope {

namespace {

int affinity_count() {
  cpu_set_t mask;
  CPU_ZERO(&mask);
  if (sched_getaffinity(0, sizeof(mask), &mask) != 0) return omp_get_num_procs();
  return std::max(1, CPU_COUNT(&mask));
}

// cgroup v2 cpu.max ("max 100000" or "200000 100000"), then v1; no quota: a large number
int cgroup_quota() {
  std::ifstream v2("/sys/fs/cgroup/cpu.max");
  std::string quota;
  double period = 0.0;
  if (v2 >> quota >> period && quota != "max" && period > 0.0)
    return std::max(1, static_cast<int>(std::ceil(std::atof(quota.c_str()) / period)));
  std::ifstream v1_quota("/sys/fs/cgroup/cpu/cpu.cfs_quota_us");
  std::ifstream v1_period("/sys/fs/cgroup/cpu/cpu.cfs_period_us");
  double microseconds = 0.0;
  if (v1_quota >> microseconds && v1_period >> period && microseconds > 0.0 && period > 0.0)
    return std::max(1, static_cast<int>(std::ceil(microseconds / period)));
  return std::numeric_limits<int>::max();
}

// the leading number of an environment variable ("4", or "4,2" of nested OpenMP); 0 when unset or not a count
int environment_count(char const* name) {
  char const* text = std::getenv(name);
  if (!text) return 0;
  long const value = std::strtol(text, nullptr, 10);
  return value >= 1 && value <= 1'000'000 ? static_cast<int>(value) : 0;
}

}  // namespace

ThreadChoice choose_threads(int requested) {
  int const mask = affinity_count();
  int const quota = cgroup_quota();
  int const available = std::min(mask, quota);
  ThreadChoice choice{available, quota < mask ? "cgroup quota" : "affinity mask"};
  if (requested >= 1) {
    choice = {requested, "--threads"};
  } else if (int const omp = environment_count("OMP_NUM_THREADS"); omp >= 1) {
    choice = {omp, "OMP_NUM_THREADS"};
  } else if (int const slurm = environment_count("SLURM_CPUS_PER_TASK"); slurm >= 1) {
    choice = {slurm, "SLURM_CPUS_PER_TASK"};
  }
  if (choice.count > mask) {
    choice.warning = fmt::format("{} asks for {} threads, this process may use {}", choice.reason, choice.count, mask);
    choice.count = mask;
  }
  return choice;
}

namespace {

// of the Stoppable that this thread works under; nullptr: none
thread_local std::function<bool()> const* stop_question = nullptr;

}  // namespace

Stoppable::Stoppable(std::function<bool()> const& must_stop) : before_(stop_question) {
  if (must_stop) stop_question = &must_stop;
}

Stoppable::~Stoppable() { stop_question = before_; }

namespace {

// Where a limit of memory or of processes lets no thread start, libgomp ends the process with words and a code of its
// own. So as many as the largest team has are started once before: std::bad_alloc where they do not start
void require_threads(int team) {
  static std::atomic<int> proven{1};
  if (team <= proven.load()) return;
  std::vector<std::thread> others;
  bool all_start = true;
  std::mutex gate;
  try {
    std::lock_guard const closed(gate);
    for (int i = 1; i < team; ++i) others.emplace_back([&gate] { std::lock_guard const open(gate); });
  } catch (std::exception const&) {
    all_start = false;
  }
  for (auto& other : others) other.join();
  if (!all_start) throw std::bad_alloc();
  proven.store(std::max(team, proven.load()));
}

}  // namespace

void parallel_for(std::size_t n, int threads, std::function<void(std::size_t, int)> const& task) {
  std::mutex guard;
  std::exception_ptr failure;
  std::size_t failed_index = std::numeric_limits<std::size_t>::max();
  std::atomic<bool> stop{false};
  std::atomic<std::size_t> next{0};
  int const team = static_cast<int>(
      std::min<std::size_t>(static_cast<std::size_t>(std::max(1, threads)), std::max<std::size_t>(1, n)));
  require_threads(team);
  std::function<bool()> const* const question = stop_question;
  std::function<bool()> const nothing_to_ask;
#pragma omp parallel num_threads(team)
  {
    Stoppable const stoppable(question != nullptr ? *question : nothing_to_ask);
    int const thread = omp_get_thread_num();
    // relaxed: tasks are independent, and an order the counter gave them by chance would hide a race from the sanitizer
    while (!stop.load(std::memory_order_relaxed)) {
      std::size_t const index = next.fetch_add(1, std::memory_order_relaxed);
      if (index >= n) break;
      try {
        if (question != nullptr && (*question)()) throw Stopped();
        task(index, thread);
      } catch (...) {
        std::lock_guard const lock(guard);
        stop.store(true, std::memory_order_relaxed);
        if (index < failed_index) {
          failed_index = index;
          failure = std::current_exception();
        }
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace torquescope
