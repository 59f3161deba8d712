#include "engine/experiment/runs/run_scheduler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace torquescope {
namespace run_scheduler_test {

// one result per run of a group
auto each(std::size_t first, std::size_t count, auto const& result_of) {
  std::vector<std::size_t> results;
  for (std::size_t index = first; index < first + count; ++index) results.push_back(result_of(index));
  return results;
}

TEST(ScheduleRuns, CommitsInOrderWhateverFinishesFirst) {
  for (int threads : {1, 2, 3}) {
    for (std::size_t most : {1u, 4u, 100u}) {
      std::vector<std::size_t> committed;
      schedule_runs(
          20, threads, most,
          [](std::size_t first, std::size_t count, int) {
            // early runs take longest: later ones must wait for them
            std::this_thread::sleep_for(std::chrono::milliseconds(first % 3 == 0 ? 5 : 0));
            return each(first, count, [](std::size_t index) { return index * index; });
          },
          [&](std::size_t index, std::size_t result) {
            EXPECT_EQ(result, index * index);
            committed.push_back(index);
          });
      ASSERT_EQ(committed.size(), 20u);
      for (std::size_t i = 0; i < committed.size(); ++i) EXPECT_EQ(committed[i], i);
    }
  }
}

TEST(ScheduleRuns, AFailedRunIsToldAndNothingOfItsGroupOrBehindIsCommitted) {
  for (std::size_t most : {1u, 3u}) {
    std::vector<std::size_t> committed;
    auto const failing = [](std::size_t first, std::size_t count, int) {
      return each(first, count, [](std::size_t index) {
        if (index == 2) throw std::runtime_error("third run");
        return index;
      });
    };
    EXPECT_THROW(
        schedule_runs(6, 2, most, failing, [&](std::size_t index, std::size_t) { committed.push_back(index); }),
        std::runtime_error);
    for (std::size_t index : committed) EXPECT_LT(index, most == 1 ? 2u : 0u);
  }
}

TEST(GroupCount, NeverLeavesAThreadWithoutAGroupThatCouldHaveOne) {
  EXPECT_EQ(group_count(30, 2, 1), 30u);  // alone
  EXPECT_EQ(group_count(30, 1, 4), 8u);   // 4 4 4 4 4 4 3 3
  EXPECT_EQ(group_count(30, 2, 4), 8u);   // four for each thread
  EXPECT_EQ(group_count(10, 4, 4), 4u);   // 2 or 3 runs for each thread, not 4 4 2 0
  EXPECT_EQ(group_count(3, 4, 4), 3u);    // fewer runs than threads: alone
  EXPECT_EQ(group_count(0, 4, 4), 0u);
  for (std::size_t runs = 1; runs < 40; ++runs)
    for (int threads : {1, 2, 3, 7})
      for (std::size_t most : {2u, 4u, 9u}) {
        std::size_t const groups = group_count(runs, threads, most);
        EXPECT_GE(groups, std::min(runs, static_cast<std::size_t>(threads)));
        EXPECT_LE((runs + groups - 1) / groups, most);
      }
}

TEST(TeamSize, SplitsAPopulationOnlyWhenThereAreFewerRunsThanThreads) {
  EXPECT_EQ(team_size(30, 4), 1);
  EXPECT_EQ(team_size(4, 4), 1);
  EXPECT_EQ(team_size(1, 4), 4);
  EXPECT_EQ(team_size(2, 5), 2);
  EXPECT_EQ(team_size(0, 4), 1);
}

}  // namespace run_scheduler_test
}  // namespace torquescope
