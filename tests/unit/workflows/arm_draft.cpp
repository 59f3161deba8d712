#include "engine/workflows/drafts/arm_draft.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/workflows/drafts/joint_choice.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace arm_draft_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Names = std::vector<std::string>;

TEST(ColumnPattern, HasAMarkWhereTheJointIsNamedOrNumbered) {
  Names const joints{"elbow", "wrist"};
  EXPECT_EQ(column_pattern("s/elbow/position", joints, {"s/wrist/position", "s/elbow/position"}), "s/{name}/position");
  EXPECT_EQ(column_pattern("q1_rad", joints, {"q1_rad", "q2_rad"}), "q{j}_rad");
  EXPECT_EQ(column_pattern("actual_q_0", joints, {"actual_q_0", "actual_q_1"}), "actual_q_{i}");
}

TEST(ColumnPattern, OfAJointWithoutItsColumnIsNone) {
  EXPECT_EQ(column_pattern("elbow/position", {"elbow", "wrist"}, {"elbow/position"}), std::nullopt);
  EXPECT_EQ(column_pattern("elbows/position", {"elbow", "wrist"}, {"elbows/position", "wrists/position"}), std::nullopt)
      << "a part of a word is no name";
  EXPECT_EQ(column_pattern("q10", {"a", "b"}, {"q10", "q20"}), std::nullopt);
}

class ArmDraftTest : public ::testing::Test {
 protected:
  // two joints, the wrist first
  std::filesystem::path recording() {
    std::string text = "t_s,js/wrist/position,js/elbow/position,js/wrist/effort,js/elbow/effort\n";
    for (int k = 0; k < 3000; ++k) {
      double const t = k / 250.0, q = std::sin(3 * t) + 0.3 * std::sin(8 * t), p = std::cos(2 * t);
      text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", t, q, p, 2 * std::cos(3 * t), -std::sin(2 * t));
    }
    return folder_.write("arm.csv", text);
  }

  std::filesystem::path robot(std::string const& first) {
    std::string text = "<robot name=\"a\"><link name=\"l0\"/><link name=\"l1\"/><link name=\"l2\"/>";
    for (auto const& [name, parent, child] : {std::tuple{first, 0, 1}, std::tuple{std::string("wrist"), 1, 2}})
      text += fmt::format(
          "<joint name=\"{}\" type=\"revolute\"><parent link=\"l{}\"/><child link=\"l{}\"/><origin xyz=\"0 0 0.3\"/>"
          "<axis xyz=\"0 1 0\"/><limit lower=\"-3\" upper=\"3\" effort=\"9\" velocity=\"9\"/></joint>",
          name, parent, child);
    return folder_.write("arm.urdf", text + "</robot>");
  }

  test::TemporaryFolder folder_;
};

TEST_F(ArmDraftTest, NamesTheColumnsOfAllJoints) {
  auto const made = draft_arm_job({recording()}, robot("elbow"), folder_ / "job.toml");
  EXPECT_THAT(made.text,
              AllOf(HasSubstr("position = \"js/{name}/position\""), HasSubstr("torque = \"js/{name}/effort\""),
                    HasSubstr("arm.urdf\""), HasSubstr("name = \"wls\"")));
  EXPECT_EQ(made.code, ExitCode::ok) << made.warnings.back();
}

TEST_F(ArmDraftTest, OfAnotherRobotHasLinesToEdit) {
  auto const made = draft_arm_job({recording()}, robot("shoulder"), folder_ / "job.toml");
  EXPECT_EQ(made.code, ExitCode::bad_job);
  EXPECT_THAT(made.text, HasSubstr("# position = "));
  EXPECT_THAT(made.warnings.front(), HasSubstr("the file has positions js/wrist/position, js/elbow/position"));
}

TEST_F(ArmDraftTest, OfARobotWithBranchesIsOfTheArmThatWasChosen) {
  auto const two_arms = [this] {
    std::string text = "<robot name=\"a\">";
    for (auto const* link : {"l0", "l1", "l2", "r1"}) text += fmt::format("<link name=\"{}\"/>", link);
    for (auto const& [name, parent, child] :
         {std::tuple{"elbow", "l0", "l1"}, std::tuple{"wrist", "l1", "l2"}, std::tuple{"other", "l0", "r1"}})
      text += fmt::format(
          "<joint name=\"{}\" type=\"revolute\"><parent link=\"{}\"/><child link=\"{}\"/><axis xyz=\"0 1 0\"/>"
          "<limit lower=\"-3\" upper=\"3\" effort=\"9\" velocity=\"9\"/></joint>",
          name, parent, child);
    return folder_.write("two.urdf", text + "</robot>");
  }();
  EXPECT_THROW(draft_arm_job({recording()}, two_arms, folder_ / "job.toml"), Error);
  auto const made = draft_arm_job({recording()}, two_arms, folder_ / "job.toml", {"l0", "l2"});
  EXPECT_THAT(made.text, AllOf(HasSubstr("root = \"l0\""), HasSubstr("tip = \"l2\""),
                               HasSubstr("position = \"js/{name}/position\"")));
  EXPECT_EQ(made.code, ExitCode::ok) << made.warnings.back();
}

TEST_F(ArmDraftTest, AJointIsChosenByNameOrByItsPlaceInTheFile) {
  auto const file = recording();
  EXPECT_EQ(joint_number(file, ""), 0u);
  EXPECT_EQ(joint_number(file, "2"), 2u);
  EXPECT_EQ(joint_number(file, "wrist"), 1u);
  EXPECT_EQ(joint_number(file, "elbow"), 2u);
  EXPECT_EQ(joint_number(file, "js/elbow/position"), 2u);
  try {
    joint_number(file, "elbwo");
    FAIL();
  } catch (Error const& error) {
    EXPECT_EQ(error.problems().front().code, ExitCode::usage);
    EXPECT_THAT(error.problems().front().notes.front(), HasSubstr("wrist, elbow"));
  }
}

}  // namespace arm_draft_test
}  // namespace torquescope
