// Whoever is ended by force says by what, quiet or not, and holds no lock afterwards.

#include "engine/app/terminal/interrupt.hpp"

#include <gtest/gtest.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): raise is enough, but the numbers are POSIX
#include <unistd.h>

#include "engine/store/shard_lock.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace interrupt_test {

// in the middle of a step that never ends
[[noreturn]] void stop_while_busy(std::filesystem::path const& result, int times, int number) {
  install_stop_signals(StopNotice::silent);
  ShardLock const lock(result, ShardChoice{});
  for (int i = 0; i < times; ++i) ::raise(number);
  for (;;) ::pause();
}

TEST(AStopInAStepThatTakesLong, IsSaidEvenWhenQuietAndTakesTheLockAway) {
  test::TemporaryFolder const folder;
  EXPECT_EXIT(stop_while_busy(folder / "R.h5", 1, SIGTERM), testing::ExitedWithCode(75),
              "SIGTERM: stopped in the middle of a generation");
  EXPECT_EQ(folder.n_files(), 0u) << "no lock is left";
}

TEST(TheSecondCtrlC, TakesTheLockAway) {
  test::TemporaryFolder const folder;
  EXPECT_EXIT(stop_while_busy(folder / "R.h5", 2, SIGINT), testing::ExitedWithCode(130), "");
  EXPECT_EQ(folder.n_files(), 0u) << "no lock is left";
}

TEST(DropHeldLock, LeavesWhatSomebodyElseHolds) {
  test::TemporaryFolder const folder;
  ShardLock const held(folder / "R.h5", ShardChoice{});
  { ShardLock const other(folder / "S.h5", ShardChoice{}); }
  drop_held_lock();
  EXPECT_EQ(locks_in(segment_folder_of(folder / "R.h5")).size(), 1u) << "the last one made has gone already";
}

}  // namespace interrupt_test
}  // namespace torquescope
