// Which part of a robot is the arm: branches, floating bases, followers; files of the usual structure.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/robot_registry.hpp"
#include "support/temporary_folder.hpp"
#include "unit/robot/small_robots.hpp"

namespace torquescope {
namespace robot_limbs_test {

SerialChain read(std::string const& text, RobotPart const& part = {}) {
  test::TemporaryFolder const folder;
  return read_robot(folder.write("robot.urdf", text), part);
}

Problem refused(std::string const& text, RobotPart const& part = {}) {
  try {
    read(text, part);
  } catch (Error const& error) {
    return error.problems().front();
  }
  ADD_FAILURE() << "was read";
  return {};
}

TEST(RobotLimbs, FilesOfTheUsualStructureAreRead) {
  EXPECT_EQ(read(test::six_joint_urdf()).size(), 6);
  EXPECT_EQ(read(test::continuous_urdf()).size(), 7);
  EXPECT_EQ(read(test::jaw_urdf()).size(), 6);
  auto const hand = read(test::hand_urdf(), {"", "hand"});
  EXPECT_EQ(hand.size(), 7);
  EXPECT_THAT(hand.remarks, testing::Contains(testing::HasSubstr("\"finger_2\" follows \"finger_1\"")));
  EXPECT_THAT(hand.warnings, testing::IsEmpty());
  EXPECT_THAT(read(test::quadruped_urdf(), {"trunk", "FL_foot"}).warnings, testing::IsEmpty());
}

TEST(RobotLimbs, AFollowerOfTheArmIsRefusedWithTheWayOut) {
  auto const problem = refused(test::hand_urdf());
  EXPECT_THAT(problem.what, testing::HasSubstr("\"finger_2\" follows \"finger_1\""));
  EXPECT_THAT(problem.help, testing::HasSubstr("tip"));
  EXPECT_THAT(problem.place.line_text, testing::HasSubstr("mimic"));
}

TEST(RobotLimbs, BranchesNameTheirEnds) {
  auto const problem = refused(test::quadruped_urdf(), {"trunk", ""});
  EXPECT_THAT(problem.what, testing::HasSubstr("ends in 4 places"));
  EXPECT_THAT(problem.notes, testing::Contains("tip = \"FL_foot\": FL_hip_joint, FL_thigh_joint, FL_calf_joint"));
  EXPECT_THAT(problem.notes, testing::SizeIs(4));
  EXPECT_GT(problem.place.line, 0);
}

TEST(RobotLimbs, AFloatingBaseIsToldWhichLineToWrite) {
  for (auto const& text : {test::quadruped_urdf(), test::quadruped_mjcf()}) {
    auto const problem = refused(text);
    EXPECT_THAT(problem.what, testing::HasSubstr("floats"));
    EXPECT_THAT(problem.help, testing::HasSubstr("root = \"trunk\" and tip = \"FL_"));
    EXPECT_GT(problem.place.line, 0);
  }
  EXPECT_THAT(refused(test::quadruped_urdf(), {"", "FR_foot"}).help, testing::HasSubstr("root = \"trunk\""));
}

TEST(RobotLimbs, TheLegIsThatOfARobotWhoseTrunkIsFixed) {
  auto fixed = test::quadruped_urdf();
  std::string const floating = "type=\"floating\"";
  fixed.replace(fixed.find(floating), floating.size(), "type=\"fixed\"");
  auto const leg = read(test::quadruped_urdf(), {"trunk", "RR_foot"}), same = read(fixed, {"", "RR_foot"});
  Eigen::VectorXd const q = Eigen::Vector3d(0.3, 0.8, -1.2), dq = Eigen::Vector3d(1, -1, 2), ddq = q;
  auto const tau = [&](SerialChain const& chain) {
    return inverse_dynamics(chain, standard_parameters(chain, DriveInertias::left_out), q, dq, ddq);
  };
  EXPECT_EQ(tau(leg), tau(same));
}

TEST(RobotLimbs, ARootWithinAnArmHoldsWhatIsBefore) {
  auto const chain = read(test::six_joint_urdf(), {"link_2", "link_5"});
  ASSERT_EQ(chain.size(), 3);
  EXPECT_EQ(chain.joints[0].name, "joint_3");
  EXPECT_THAT(chain.remarks, testing::Contains(testing::HasSubstr("\"joint_2\" is before the arm's root")));
}

TEST(RobotLimbs, LinksThatAreNotThereGetASuggestion) {
  EXPECT_THAT(refused(test::quadruped_urdf(), {"trunk", "FL_fot"}).what,
              testing::HasSubstr("did you mean \"FL_foot\""));
  EXPECT_THAT(refused(test::six_joint_urdf(), {"tool0", "link_3"}).what, testing::HasSubstr("not on the way"));
  EXPECT_THAT(refused(test::six_joint_urdf(), {"tool0", ""}).what, testing::HasSubstr("no joint behind"));
}

TEST(RobotLimbs, AFileOfOnesOwnNamesThePartToo) {
  test::TemporaryFolder const folder;
  folder.write("dog.xml", test::quadruped_mjcf());
  auto const chain =
      read_robot(folder.write("leg.toml",
                              "[robot]\nurdf = \"dog.xml\"\nroot = \"trunk\"\ntip = \"FL_calf\"\n[[joint]]\nname = "
                              "\"FL_hip_joint\"\ngear_ratio = 6.33\n"));
  ASSERT_EQ(chain.size(), 3);
  EXPECT_EQ(chain.joints[0].gear_ratio, 6.33);
  EXPECT_NEAR(chain.gravity.norm(), 9.81, 1e-12);
}

}  // namespace robot_limbs_test
}  // namespace torquescope
