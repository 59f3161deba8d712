// A xacro is written out by the program xacro: one of our own stands in for it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "engine/robot/robot_registry.hpp"
#include "support/temporary_folder.hpp"
#include "unit/robot/small_robots.hpp"

namespace torquescope {
namespace xacro_test {

class Path {
 public:
  explicit Path(std::string const& folder) : before_(std::getenv("PATH")) { ::setenv("PATH", folder.c_str(), 1); }
  ~Path() { ::setenv("PATH", before_.c_str(), 1); }
  Path(Path const&) = delete;
  Path& operator=(Path const&) = delete;

 private:
  std::string before_;
};

std::string const macro =
    "<robot name='x' xmlns:xacro='http://ros.org/wiki/xacro'>\n<xacro:include filename='y'/>\n</robot>";

void install(test::TemporaryFolder const& folder, std::string const& script) {
  auto const program = folder.write("xacro", "#!/bin/sh\n" + script);
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
}

Problem refused(test::TemporaryFolder const& folder) {
  Path const path(folder.path().string());
  try {
    read_robot(folder.write("arm.urdf.xacro", macro));
  } catch (Error const& error) {
    return error.problems().front();
  }
  ADD_FAILURE() << "was read";
  return {};
}

TEST(Xacro, IsWrittenOutByTheProgramOfThatName) {
  test::TemporaryFolder const folder;
  auto const urdf = folder.write("made.urdf", test::six_joint_urdf());
  // the file is its only argument
  install(folder,
          "test $# = 1 && test -f \"$1\" && while read -r line; do echo \"$line\"; done < " + urdf.string() + "\n");
  Path const path(folder.path().string());
  EXPECT_EQ(read_robot(folder.write("arm.urdf.xacro", macro)).size(), 6);
}

TEST(Xacro, WithoutTheProgramTheCommandIsTold) {
  test::TemporaryFolder const folder;
  auto const problem = refused(folder);
  EXPECT_THAT(problem.what, testing::HasSubstr("not installed"));
  EXPECT_THAT(problem.help, testing::HasSubstr("xacro "));
  EXPECT_EQ(problem.place.line, 2);
}

TEST(Xacro, WhatTheProgramSaysOfAFailureIsPassedOn) {
  test::TemporaryFolder const folder;
  install(folder, "echo 'No such file: y' >&2\nexit 2\n");
  auto const problem = refused(folder);
  EXPECT_THAT(problem.what, testing::HasSubstr("could not write"));
  EXPECT_THAT(problem.notes, testing::ElementsAre("xacro: No such file: y"));
}

}  // namespace xacro_test
}  // namespace torquescope
