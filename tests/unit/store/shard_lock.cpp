// One living process per share; whoever comes second is told who is first, and the dead hold nothing.

#include "engine/store/shard_lock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <optional>

#include "engine/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace shard_lock_test {

namespace fs = std::filesystem;

TEST(ShardLock, IsHeldByOneAndSaysByWhom) {
  test::TemporaryFolder const folder;
  fs::path const result = folder / "R.h5";
  std::optional<ShardLock> first(std::in_place, result, ShardChoice{1, 4});
  try {
    ShardLock const second(result, ShardChoice{1, 4});
    FAIL() << "two at one share";
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::exists);
    EXPECT_THAT(error.what(), testing::HasSubstr("shard 1/4 of " + result.string() + " is at work already: process " +
                                                 std::to_string(::getpid()) + " on " + host_name()));
  }
  EXPECT_NO_THROW(ShardLock(result, ShardChoice{2, 4})) << "another share";
  EXPECT_NO_THROW(ShardLock(result, ShardChoice{0, 1})) << "the whole job: what both write is equal";
  first.reset();
  EXPECT_NO_THROW(ShardLock(result, ShardChoice{1, 4}));
  EXPECT_EQ(folder.n_files(), 0u) << "nothing is left";
}

TEST(ShardLock, KeepsWhatItsProcessSaidLast) {
  test::TemporaryFolder const folder;
  fs::path const parts = folder / "R.h5.parts";
  EXPECT_TRUE(locks_in(parts).empty()) << "no folder, no lock";
  {
    ShardLock const lock(folder / "R.h5", {});
    lock.say("a long text that is said first");
    lock.say("the last");
    auto const found = locks_in(parts);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].who, "process " + std::to_string(::getpid()) + " on " + host_name());
    EXPECT_EQ(found[0].said, "the last");
    EXPECT_TRUE(found[0].is_alive);
  }
  fs::create_directory(parts);
  folder.write("R.h5.parts/shard-0000-of-0001.lock", "process 1 on nowhere\nwhat it said");
  folder.write("R.h5.parts/shard-0001-of-0001.lock", "somebody's file of that name");
  auto const found = locks_in(parts);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].said, "what it said");
  EXPECT_FALSE(found[0].is_alive) << "nobody holds it";
}

TEST(ShardLock, OfADeadProcessIsTaken) {
  test::TemporaryFolder const folder;
  fs::create_directory(folder / "R.h5.parts");
  folder.write("R.h5.parts/shard-0000-of-0001.lock", "process 1 on nowhere");
  EXPECT_NO_THROW(ShardLock(folder / "R.h5", {}));
  EXPECT_FALSE(fs::exists(folder / "R.h5.parts"));
}

TEST(ShardLock, ThatCannotBeMadeStopsNobody) { EXPECT_NO_THROW(ShardLock("/nowhere/at/all/R.h5", {})); }

}  // namespace shard_lock_test
}  // namespace torquescope
