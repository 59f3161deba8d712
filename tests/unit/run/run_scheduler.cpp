#include "engine/run/run_scheduler.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace torquescope {
namespace {

TEST(ScheduleRuns, CommitsInOrderWhateverFinishesFirst) {
  for (int threads : {1, 2, 3}) {
    std::vector<std::size_t> committed;
    schedule_runs(
        20, threads,
        [](std::size_t index, int) {
          // early runs take longest: later ones must wait for them
          std::this_thread::sleep_for(std::chrono::milliseconds(index % 3 == 0 ? 5 : 0));
          return index * index;
        },
        [&](std::size_t index, std::size_t result) {
          EXPECT_EQ(result, index * index);
          committed.push_back(index);
        });
    ASSERT_EQ(committed.size(), 20u);
    for (std::size_t i = 0; i < committed.size(); ++i) EXPECT_EQ(committed[i], i);
  }
}

TEST(ScheduleRuns, AFailedRunIsToldAndNothingBehindItIsCommitted) {
  std::vector<std::size_t> committed;
  auto const failing = [](std::size_t index, int) {
    if (index == 2) throw std::runtime_error("third run");
    return index;
  };
  EXPECT_THROW(schedule_runs(6, 2, failing, [&](std::size_t index, std::size_t) { committed.push_back(index); }),
               std::runtime_error);
  for (std::size_t index : committed) EXPECT_LT(index, 2u);
}

TEST(TeamSize, SplitsAPopulationOnlyWhenThereAreFewerRunsThanThreads) {
  EXPECT_EQ(team_size(30, 4), 1);
  EXPECT_EQ(team_size(4, 4), 1);
  EXPECT_EQ(team_size(1, 4), 4);
  EXPECT_EQ(team_size(2, 5), 2);
  EXPECT_EQ(team_size(0, 4), 1);
}

}  // namespace
}  // namespace torquescope
