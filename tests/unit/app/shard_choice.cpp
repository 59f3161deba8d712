// Which share of the runs a process takes: what was asked for, else its place in the batch system, else all.

#include "engine/app/commands/shard_choice.hpp"

#include <gtest/gtest.h>

#include <map>

#include "engine/base/error.hpp"

namespace torquescope {
namespace shard_choice_test {

using Variables = std::map<std::string, std::string>;

ShardChoice chosen(Variables const& variables, std::string const& given = "") {
  return choose_shard(given, [&](char const* name) {
    auto const found = variables.find(name);
    return found == variables.end() ? std::string() : found->second;
  });
}

void expect(ShardChoice const& shard, std::size_t index, std::size_t count, std::string const& reason) {
  EXPECT_EQ(shard.index, index);
  EXPECT_EQ(shard.count, count);
  EXPECT_EQ(shard.reason, reason);
}

Variables array(std::string const& id, std::string const& first, std::string const& last, std::string const& count,
                std::string const& step = "1") {
  return {{"SLURM_ARRAY_TASK_ID", id},
          {"SLURM_ARRAY_TASK_MIN", first},
          {"SLURM_ARRAY_TASK_MAX", last},
          {"SLURM_ARRAY_TASK_COUNT", count},
          {"SLURM_ARRAY_TASK_STEP", step}};
}

TEST(ShardChoice, IsEverythingUnlessSomebodySaysOtherwise) {
  expect(chosen({}), 0, 1, "");
  expect(chosen({{"SLURM_JOB_ID", "7"}}), 0, 1, "");
  // in the batch script itself: four tasks are reserved, one process runs
  expect(chosen({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "4"}}), 0, 1, "");
  expect(chosen(array("5", "5", "5", "1")), 0, 1, "");
}

TEST(ShardChoice, FollowsTheBatchSystem) {
  expect(chosen(array("3", "0", "9", "10")), 3, 10, "SLURM_ARRAY_TASK_ID");
  expect(chosen(array("1", "1", "4", "4")), 0, 4, "SLURM_ARRAY_TASK_ID");
  expect(chosen(array("20", "10", "30", "3", "10")), 1, 3, "SLURM_ARRAY_TASK_ID");
  expect(chosen({{"SLURM_PROCID", "2"}, {"SLURM_STEP_NUM_TASKS", "8"}}), 2, 8, "SLURM_PROCID");
  expect(chosen({{"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "2"}}), 1, 2, "OMPI_COMM_WORLD_RANK");
  auto both = array("2", "0", "3", "4");
  both["SLURM_PROCID"] = "1";
  both["SLURM_STEP_NUM_TASKS"] = "2";
  expect(chosen(both), 5, 8, "SLURM_ARRAY_TASK_ID, SLURM_PROCID");
}

TEST(ShardChoice, TheUserHasTheLastWord) {
  expect(chosen(array("3", "0", "9", "10"), "0/1"), 0, 1, "--shard");
  expect(chosen({}, "2/3"), 2, 3, "--shard");
}

TEST(ShardChoice, AnArrayWithGapsIsRefusedNotGuessed) {
  try {
    chosen(array("7", "1", "7", "3"));
    FAIL();
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
  }
}

TEST(ShardText, IsIOfN) {
  for (auto const* good : {"0/1", "3/4", "99/100"}) EXPECT_EQ(no_shard(good), "") << good;
  for (auto const* bad : {"", "1", "4/4", "-1/2", "1/0", "a/b", "1/2/3", "0x1/2", " 0/2", "0/99999999999"})
    EXPECT_NE(no_shard(bad), "") << bad;
}

}  // namespace shard_choice_test
}  // namespace torquescope
