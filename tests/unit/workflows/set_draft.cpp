// Sections that take exactly the files of a list, and which of them judge.

#include "engine/workflows/drafts/set_draft.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/experiment/file_pattern.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace set_draft_test {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAreArray;
using Names = std::vector<std::string>;

class SetDraftTest : public ::testing::Test {
 protected:
  SetDraft draft(Names const& files, Names const& others = {}) {
    for (auto const& list : {files, others})
      for (auto const& file : list) {
        std::filesystem::create_directories((folder_.path() / file).parent_path());
        folder_.write(file, "x");
      }
    auto made = draft_set(files, folder_.path());
    Names found;
    std::size_t n_more = 0;
    for (auto const& section : made.sections) {
      n_more += section.n_more;
      for (auto const& match : files_matching(folder_.path(), section.files)) found.push_back(match.file);
    }
    if (n_more == 0) {
      EXPECT_THAT(found, UnorderedElementsAreArray(files));
    }
    return made;
  }

  static Names patterns(SetDraft const& made) {
    Names list;
    for (auto const& section : made.sections) list.push_back((section.is_validation ? "!" : "") + section.files);
    return list;
  }

  test::TemporaryFolder folder_;
};

TEST_F(SetDraftTest, OnePatternTakesFilesThatShareOne) {
  auto const made = draft({"logs/m1_kp8_x.csv", "logs/m2_kp8_y.csv"}, {"logs/notes.csv", "m3_kp8_x.csv"});
  EXPECT_THAT(patterns(made), ElementsAre("logs/m{mass_kg}_kp{kp}_{motion}.csv"));
}

TEST_F(SetDraftTest, AnInnerMassJudges) {
  Names files;
  for (auto const* mass : {"0.5", "0.75", "1"})
    for (auto const* motion : {"steps", "two_sines"})
      files.push_back(std::string("m") + mass + "_l150_" + motion + ".csv");
  auto const made = draft(files);
  EXPECT_THAT(patterns(made), ElementsAre("m0.5_l{length_mm}_{motion}.csv", "m1_l{length_mm}_{motion}.csv",
                                          "!m0.75_l{length_mm}_{motion}.csv"));
  EXPECT_EQ(made.judged_by, "mass_kg");
  EXPECT_EQ(made.sections[2].fixed.at("mass_kg"), "0.75");
}

TEST_F(SetDraftTest, AnInnerMassJudgesAmongFilesThatAreNotMeant) {
  Names files, others;
  for (char const* mass : {"0.5", "0.75", "1"})
    for (char const* motion : {"steps", "two_sines", "drop"})
      for (char const* kp : {"8", "32"}) {
        bool const is_meant = std::string(motion) != "drop" && std::string(kp) == "8";
        (is_meant ? files : others).push_back(std::string("m") + mass + "_kp" + kp + "_" + motion + ".csv");
      }
  auto const made = draft(files, others);
  EXPECT_EQ(made.judged_by, "mass_kg");
  EXPECT_THAT(patterns(made), ElementsAre("m0.5_kp8_steps.csv", "m0.5_kp8_two_sines.csv", "m1_kp8_steps.csv",
                                          "m1_kp8_two_sines.csv", "!m0.75_kp8_steps.csv", "!m0.75_kp8_two_sines.csv"));
}

TEST_F(SetDraftTest, AMotionJudgesWhereNoNumberCan) {
  auto const made = draft({"m1_l200_a.csv", "m1_l200_b.csv", "m1_l200_c.csv", "m1_l200_d.csv", "m1_l200_e.csv"});
  EXPECT_EQ(made.judged_by, "motion");
  EXPECT_EQ(std::count_if(made.sections.begin(), made.sections.end(), [](auto const& s) { return s.is_validation; }),
            1);
}

TEST_F(SetDraftTest, AFolderForTestsJudges) {
  auto const made = draft({"train/m1_kp8.csv", "train/m2_kp8.csv", "unseen_load/m3_kp8.csv", "unseen_load/m4_kp8.csv"});
  EXPECT_THAT(patterns(made), ElementsAre("train/m{mass_kg}_kp{kp}.csv", "!unseen_load/m{mass_kg}_kp{kp}.csv"));
}

TEST_F(SetDraftTest, FilesThatAreNotInTheListAreNotMatched) {
  auto const made = draft({"m1_l150_x.csv", "m2_l150_x.csv"}, {"m1_l200_x.csv", "m3_l200_x.csv"});
  EXPECT_THAT(patterns(made), ElementsAre("m{mass_kg}_l150_x.csv"));
  EXPECT_EQ(made.sections[0].fixed.at("length_mm"), "150");
  auto const by_mass =
      draft({"a/m1_kp8_x.csv", "a/m1_kp9_y.csv", "a/m2_kp8_x.csv", "a/m2_kp9_y.csv"}, {"a/m3_kp8_x.csv"});
  EXPECT_THAT(patterns(by_mass), ElementsAre("a/m1_kp{kp}_{motion}.csv", "a/m2_kp{kp}_{motion}.csv"));
}

TEST_F(SetDraftTest, NamesWithoutAPatternStandOneByOneOrAsAStar) {
  auto const few = draft({"alpha.csv", "m1-kp3.h5"});
  EXPECT_THAT(patterns(few), ElementsAre("alpha.csv", "m1-kp3.h5"));
  EXPECT_THAT(few.quantities, IsEmpty());
  Names many;
  for (char letter = 'a'; letter <= 'p'; ++letter)
    many.push_back(std::string("log_") + letter + (letter < 'd' ? ".h5" : ".csv"));
  auto const starred = draft(many, {"log_other.csv"});
  EXPECT_THAT(patterns(starred), ElementsAre("log_*"));
  EXPECT_EQ(starred.sections[0].n_more, 1u);
}

TEST_F(SetDraftTest, OfOneFileThePatternIsItsName) {
  auto const made = draft({"m1_l150_kp8_steps.csv"}, {"m2_l150_kp8_steps.csv"});
  EXPECT_THAT(patterns(made), ElementsAre("m1_l150_kp8_steps.csv"));
  EXPECT_EQ(made.sections[0].fixed.at("length_mm"), "150");
}

}  // namespace set_draft_test
}  // namespace torquescope
