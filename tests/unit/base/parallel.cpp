#include "engine/base/parallel.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <vector>

namespace torquescope {
namespace parallel_test {

TEST(ParallelFor, RunsEveryIndexOnce) {
  for (int threads : {1, 2, 3}) {
    std::vector<std::atomic<int>> seen(1000);
    parallel_for(seen.size(), threads, [&](std::size_t i, int) { ++seen[i]; });
    for (auto const& count : seen) EXPECT_EQ(count.load(), 1);
  }
}

TEST(ParallelFor, RethrowsAfterTheRegion) {
  EXPECT_THROW(parallel_for(50, 2,
                            [](std::size_t i, int) {
                              if (i == 13) throw std::runtime_error("thirteen");
                            }),
               std::runtime_error);
}

TEST(Stoppable, BeginsNoTaskOnceItIsToStop) {
  for (int threads : {1, 2}) {
    std::atomic<int> begun{0};
    std::function<bool()> const after_ten = [&] { return begun.load() >= 10; };
    Stoppable const stoppable(after_ten);
    EXPECT_THROW(parallel_for(1000, threads, [&](std::size_t, int) { ++begun; }), Stopped);
    EXPECT_LT(begun.load(), 10 + threads);
  }
}

TEST(Stoppable, IsAskedBeforeTheTasksOfATask) {
  std::atomic<bool> is_to_stop{false};
  std::atomic<int> inner{0};
  std::function<bool()> const question = [&] { return is_to_stop.load(); };
  Stoppable const stoppable(question);
  EXPECT_THROW(parallel_for(2, 2,
                            [&](std::size_t, int) {
                              is_to_stop.store(true);
                              parallel_for(5, 1, [&](std::size_t, int) { ++inner; });
                            }),
               Stopped);
  EXPECT_EQ(inner.load(), 0);
}

TEST(Stoppable, EndsWithItsScope) {
  std::function<bool()> const at_once = [] { return true; };
  {
    Stoppable const stoppable(at_once);
    EXPECT_THROW(parallel_for(3, 2, [](std::size_t, int) {}), Stopped);
  }
  EXPECT_NO_THROW(parallel_for(3, 2, [](std::size_t, int) {}));
}

TEST(ChooseThreads, FollowsTheOrderOfReasons) {
  setenv("OMP_NUM_THREADS", "1", 1);
  EXPECT_EQ(choose_threads(0).reason, "OMP_NUM_THREADS");
  EXPECT_EQ(choose_threads(1).reason, "--threads");
  unsetenv("OMP_NUM_THREADS");
  setenv("SLURM_CPUS_PER_TASK", "1", 1);
  EXPECT_EQ(choose_threads(0).reason, "SLURM_CPUS_PER_TASK");
  unsetenv("SLURM_CPUS_PER_TASK");
}

TEST(ChooseThreads, NeverExceedsTheAffinityMask) {
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof(before), &before), 0);
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(cpu, &before)) {
      CPU_SET(cpu, &one);
      break;
    }
  ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
  auto const choice = choose_threads(8);
  sched_setaffinity(0, sizeof(before), &before);
  EXPECT_EQ(choice.count, 1);
  EXPECT_FALSE(choice.warning.empty());
}

}  // namespace parallel_test
}  // namespace torquescope
