// A program ends when it goes round in circles, when this process ends, and otherwise by itself.

#include "engine/app/report/child_program.hpp"

#include <gtest/gtest.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <thread>

#include "support/temporary_folder.hpp"

namespace torquescope {
namespace child_program_test {

ProgramEnd shell(std::string const& text, int seconds = 10) {
  return run_program({"sh", "-c", text}, Voice::silent, seconds);
}

TEST(ChildProgram, GivesItsExitStatus) {
  EXPECT_EQ(shell("exit 7").status, 7);
  EXPECT_EQ(run_program({"no-such-program-of-ours"}, Voice::silent, 10).status, 127);
  EXPECT_EQ(shell("kill -9 $$").status, std::nullopt);
  EXPECT_FALSE(shell("kill -9 $$").used_up_its_time);
}

TEST(ChildProgram, HasOneThreadForOpenBlasWhateverIsSet) {
  ::setenv("OPENBLAS_NUM_THREADS", "64", 1);
  EXPECT_EQ(shell("test \"$OPENBLAS_NUM_THREADS\" = 1 && test -n \"$PATH\"").status, 0);
  ::unsetenv("OPENBLAS_NUM_THREADS");
}

TEST(ChildProgram, ThatGoesRoundInCirclesIsStopped) {
  auto const end = shell("while :; do :; done", 1);
  EXPECT_TRUE(end.used_up_its_time);
  EXPECT_EQ(end.status, std::nullopt);
}

// as when somebody kills `report`
TEST(ChildProgram, DoesNotOutliveItsParent) {
  test::TemporaryFolder const folder;
  auto const told = folder / "pid";
  pid_t const parent = ::fork();
  if (parent == 0) {
    shell("echo $$ > '" + (folder / "new").string() + "'; mv '" + (folder / "new").string() + "' '" + told.string() +
          "'; exec sleep 100");
    ::_exit(0);
  }
  auto const wait_until = [](auto&& is_true) {
    auto const end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!is_true() && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return is_true();
  };
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(told); }));
  pid_t child = 0;
  std::ifstream(told) >> child;
  ASSERT_GT(child, 0);
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  // one that has ended and that nobody has asked after is in the list still, as "Z"
  auto const has_ended = [&] {
    std::ifstream stat("/proc/" + std::to_string(child) + "/stat");
    std::string number, name, state;
    return !(stat >> number >> name >> state) || state == "Z";
  };
  EXPECT_TRUE(wait_until(has_ended));
}

}  // namespace child_program_test
}  // namespace torquescope
