// A full disk costs nothing but the file that was being written: exit code 74, and HDF5 never takes the process down.

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <functional>

#include "engine/base/error.hpp"
#include "engine/store/result_reader.hpp"
#include "support/temporary_folder.hpp"
#include "unit/store/example_result.hpp"

namespace torquescope {
namespace disk_full_test {

constexpr int could_not_prepare = 99;

// what a program's main() does: the error's code, then the ordinary way out through every exit handler (HDF5's
// included)
[[noreturn]] void leave_as_a_program_would(std::filesystem::path const& name, bool gzip) {
  int code = 0;
  try {
    ResultWriter writer(name, {.gzip = gzip});
    example::write_job(writer);
    // enough for several chunks, an index and, without gzip, blocks that another thread writes
    writer.declare_runs("/history", 40, {100, 80}, {"1", "history"});
    for (std::size_t run = 0; run < 40; ++run)
      writer.write_run("/history", run, std::vector<double>(8000, static_cast<double>(run)));
    example::declare_fade(writer);
    for (std::size_t run = 0; run < example::runs; ++run) example::write_fade_run(writer, run);
    writer.finish();
  } catch (Error const& error) {
    code = static_cast<int>(error.code());
  }
  std::exit(code);
}

// exit code of a child that prepares and then writes; 128 + signal when it crashed
int exit_code_of_child(std::filesystem::path const& name, bool gzip, std::function<bool()> const& prepare) {
  pid_t const child = ::fork();
  if (child == 0) {
    if (!prepare()) ::_exit(could_not_prepare);
    leave_as_a_program_would(name, gzip);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int exit_code_with_room_for(std::size_t bytes, std::filesystem::path const& name, bool gzip) {
  return exit_code_of_child(name, gzip, [bytes] {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit const limit{bytes, bytes};
    return ::setrlimit(RLIMIT_FSIZE, &limit) == 0;
  });
}

TEST(DiskFull, EndsWithItsExitCodeWhereverItHappensAndLeavesNothingBehind) {
  test::TemporaryFolder const folder;
  for (bool gzip : {false, true}) {
    ASSERT_EQ(exit_code_with_room_for(std::size_t{1} << 30, folder / "whole.h5", gzip), 0);
    std::size_t const size = std::filesystem::file_size(folder / "whole.h5");
    std::filesystem::remove(folder / "whole.h5");
    constexpr std::size_t steps = 60;
    for (std::size_t i = 0; i < steps; ++i) {
      int const code = exit_code_with_room_for(size * i / steps, folder / "R.h5", gzip);
      EXPECT_EQ(code, static_cast<int>(ExitCode::io)) << "room for " << i << "/" << steps << " of the file";
      EXPECT_EQ(folder.n_files(), 0U);
    }
    // one byte short, then just enough
    EXPECT_EQ(exit_code_with_room_for(size - 1, folder / "R.h5", gzip), static_cast<int>(ExitCode::io));
    EXPECT_EQ(exit_code_with_room_for(size, folder / "R.h5", gzip), 0);
    EXPECT_NO_THROW(verify_result(folder / "R.h5"));
    std::filesystem::remove(folder / "R.h5");
  }
}

TEST(DiskFull, OfARealFileSystemKeepsTheOlderResult) {
  test::TemporaryFolder const folder;
  auto const mount_small_disk = [&] {
    // seen by this child only
    return ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           ::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=256k") == 0;
  };
  auto const check_older_result = [&] {
    if (!mount_small_disk()) return false;
    test::write_bytes(folder / "R.h5", "an older result");
    static std::filesystem::path const name = folder / "R.h5";
    std::atexit([] {
      // looked at from inside: the small disk is gone with the process
      std::error_code ignored;
      bool const kept = test::bytes_of(name) == "an older result";
      bool const alone = std::filesystem::file_size(name.parent_path() / "R.h5", ignored) == 15 &&
                         std::distance(std::filesystem::directory_iterator(name.parent_path()), {}) == 1;
      if (!kept || !alone) ::_exit(1);
    });
    return true;
  };
  int const code = exit_code_of_child(folder / "R.h5", false, check_older_result);
  if (code == could_not_prepare) GTEST_SKIP() << "only root may mount a small disk";
  EXPECT_EQ(code, static_cast<int>(ExitCode::io));
}

TEST(DiskFull, SaysWhatToDo) {
  test::TemporaryFolder const folder;
  int const code = exit_code_of_child(folder / "unused.h5", false, [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit const limit{100000, 100000};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) return false;
    try {
      ResultWriter writer(folder / "R.h5");
      writer.numbers("/a", {100000}, std::vector<double>(100000, 1.0), {"1", "a"});
      writer.finish();
    } catch (Error const& error) {
      bool const right = error.what() == "cannot write " + (folder / "R.h5").string() + ": file too large" &&
                         error.problems()[0].help.find("ulimit -f") != std::string::npos;
      ::_exit(right ? 0 : 1);
    }
    ::_exit(2);
  });
  EXPECT_EQ(code, 0);
}

}  // namespace disk_full_test
}  // namespace torquescope
