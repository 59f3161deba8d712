#include "engine/app/report/page_builder.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace torquescope {
namespace page_builder_test {

namespace fs = std::filesystem;

class PageProgram : public testing::Test {
 protected:
  fs::path make(std::string const& name) const {
    fs::create_directories((folder_ / name).parent_path());
    return folder_.write(name, "");
  }
  test::TemporaryFolder folder_{};
};

TEST_F(PageProgram, IsFoundInTheSourceTreeAboveTheBuildFolder) {
  fs::path const program = make("scripts/report/build.py");
  EXPECT_EQ(find_page_program("", folder_ / "build/dev/bin/torquescope"), program);
}

TEST_F(PageProgram, IsFoundBesideAnInstalledProgram) {
  fs::path const program = make("usr/share/torquescope/report/build.py");
  EXPECT_EQ(find_page_program("", folder_ / "usr/bin/torquescope"), program);
}

TEST_F(PageProgram, OfTheVariableComesFirst) {
  make("scripts/report/build.py");
  fs::path const program = make("mine/report/build.py");
  EXPECT_EQ(find_page_program((folder_ / "mine").string(), folder_ / "build/dev/bin/torquescope"), program);
}

TEST_F(PageProgram, IsFoundByItsName) {
  fs::path const compare = make("scripts/report/compare.py");
  EXPECT_EQ(find_page_program("", folder_ / "build/dev/bin/torquescope", "compare.py"), compare);
  EXPECT_EQ(find_page_program("", folder_ / "build/dev/bin/torquescope"), std::nullopt);
}

TEST_F(PageProgram, MayBeMissing) { EXPECT_EQ(find_page_program("", folder_ / "bin/torquescope"), std::nullopt); }

}  // namespace page_builder_test
}  // namespace torquescope
