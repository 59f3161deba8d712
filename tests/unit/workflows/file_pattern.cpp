// Which names a pattern matches, what its {names} take, and which patterns are none.

#include "engine/experiment/file_pattern.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace torquescope {
namespace file_pattern_test {

using testing::ElementsAre;
using testing::HasSubstr;
using Texts = std::map<std::string, std::string>;

std::vector<std::string> files_of(std::filesystem::path const& folder, std::string const& pattern) {
  std::vector<std::string> files;
  for (auto const& match : files_matching(folder, pattern)) files.push_back(match.file);
  return files;
}

TEST(FilePattern, GivesEachNameWhatStandsInItsPlace) {
  EXPECT_EQ(match_name("servo_m{mass_kg}_l{length_mm}_kp{kp}_{motion}.csv.gz", "servo_m0.5_l150_kp32_sin_sin.csv.gz"),
            (Texts{{"mass_kg", "0.5"}, {"length_mm", "150"}, {"kp", "32"}, {"motion", "sin_sin"}}));
}

TEST(FilePattern, MatchesAsLittleAsItCanFromTheLeft) {
  EXPECT_EQ(match_name("{a}_{b}.csv", "x_y_z.csv"), (Texts{{"a", "x"}, {"b", "y_z"}}));
  EXPECT_EQ(match_name("{a}_{b}_1.csv", "x_1_y_1.csv"), (Texts{{"a", "x"}, {"b", "1_y"}}));
}

TEST(FilePattern, NeedsALetterForANameAndNoneForAStar) {
  EXPECT_FALSE(match_name("m{mass}.csv", "m.csv"));
  EXPECT_TRUE(match_name("m*.csv", "m.csv"));
  EXPECT_FALSE(match_name("m?.csv", "m.csv"));
  EXPECT_TRUE(match_name("m?.csv", "m1.csv"));
  EXPECT_FALSE(match_name("m?.csv", "m12.csv"));
}

TEST(FilePattern, TakesManyStarsWithoutTryingEveryWay) {
  std::string stars;
  for (int k = 0; k < 40; ++k) stars += "*a";
  EXPECT_FALSE(match_name(stars + "b", std::string(200, 'a')));
  EXPECT_TRUE(match_name(std::string(100000, '*'), "a"));
}

TEST(FilePattern, FindsRegularFilesInFoldersSortedByName) {
  test::TemporaryFolder const folder;
  for (auto const* sub : {"b", "a", "a/c.csv"}) std::filesystem::create_directory(folder.path() / sub);
  for (auto const* file : {"b/2.csv", "a/9.csv", "a/10.csv", "a/.1.csv", "top.csv"}) folder.write(file, "x");
  EXPECT_THAT(files_of(folder.path(), "{robot}/{run}.csv"), ElementsAre("a/10.csv", "a/9.csv", "b/2.csv"));
  EXPECT_EQ(files_matching(folder.path(), "{robot}/{run}.csv")[2].texts, (Texts{{"robot", "b"}, {"run", "2"}}));
  EXPECT_THAT(files_of(folder.path(), "*.csv"), ElementsAre("top.csv"));
  EXPECT_THAT(files_of(folder.path(), "a/.*.csv"), ElementsAre("a/.1.csv"));
  EXPECT_THAT(files_of(folder.path(), "top.csv"), ElementsAre("top.csv"));
  EXPECT_THAT(files_of("", (folder.path() / "b/*").string()), ElementsAre((folder.path() / "b/2.csv").string()));
  EXPECT_TRUE(files_matching(folder.path(), "c/*.csv").empty());
}

TEST(FilePattern, SaysWhatIsThereInstead) {
  test::TemporaryFolder const folder;
  folder.write("1.csv.gz", "x");
  auto const facts = what_is_there(folder.path(), "{run}.csv");
  ASSERT_EQ(facts.size(), 2u);
  EXPECT_THAT(facts[0], HasSubstr("has: 1.csv.gz"));
  EXPECT_EQ(facts[1], "\"{run}.csv.gz\" matches 1 file");
  EXPECT_THAT(what_is_there(folder.path(), "train/{run}.csv")[0], HasSubstr("there is no folder"));
}

TEST(FilePattern, SaysWhyItIsNone) {
  EXPECT_EQ(fault_of_pattern("train/m{mass_kg}_*.csv"), "");
  EXPECT_EQ(fault_of_pattern(""), "it is empty");
  EXPECT_EQ(fault_of_pattern("m{mass.csv"), "a { is never closed");
  EXPECT_THAT(fault_of_pattern("m{2nd}.csv"), HasSubstr("{2nd} is no name"));
  EXPECT_THAT(fault_of_pattern("m{}.csv"), HasSubstr("{} is no name"));
  EXPECT_THAT(fault_of_pattern("{a}/{a}.csv"), HasSubstr("{a} stands there twice"));
  EXPECT_THAT(fault_of_pattern("{a}{b}.csv"), HasSubstr("nothing stands before {b}"));
}

}  // namespace file_pattern_test
}  // namespace torquescope
