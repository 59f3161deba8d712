// Robot files in TOML: those of jobs/robots, and wrong ones.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "engine/robot/base_parameters.hpp"
#include "engine/robot/forward_dynamics.hpp"
#include "engine/robot/robot_registry.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace robot_toml_test {

std::filesystem::path const robots = std::filesystem::path(TORQUESCOPE_SOURCE_DIR) / "jobs" / "robots";

struct Known {
  char const* file;
  Eigen::Index joints, rigid, with_drives;
};

class RobotOfJobs : public testing::TestWithParam<Known> {};

TEST_P(RobotOfJobs, HasTheRankOfItsTable) {
  auto const chain = read_robot(robots / GetParam().file);
  EXPECT_EQ(chain.size(), GetParam().joints);
  EXPECT_EQ(BaseParameters(chain, DriveInertias::left_out).size(), GetParam().rigid);
  EXPECT_EQ(BaseParameters(chain, DriveInertias::included).size(), GetParam().with_drives);
  EXPECT_THAT(chain.remarks, testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(All, RobotOfJobs,
                         testing::Values(Known{"crs_a465.toml", 5, 29, 32}, Known{"ur10e.toml", 6, 36, 40},
                                         Known{"panda.toml", 7, 43, 48}, Known{"puma560.toml", 6, 36, 40},
                                         Known{"tx40.toml", 6, 36, 40}));

TEST(CrsA465, StandsUprightAtZeroAndWeighsNothingAboutItsAxes) {
  auto const chain = read_robot(robots / "crs_a465.toml");
  FramePose tip;
  for (auto const& joint : chain.joints) tip = tip * joint_pose(joint, 0.0);
  tip = tip * chain.flange;
  EXPECT_NEAR(tip.position.z(), 0.3302 + 0.3048 + 0.3302 + 0.0762, 1e-12);
  EXPECT_NEAR(tip.position.head<2>().norm(), 0.0, 1e-12);
  auto const chi = standard_parameters(chain, DriveInertias::included);
  EXPECT_TRUE(is_positive_definite(mass_matrix(chain, chi, Eigen::VectorXd::Zero(5))));
  EXPECT_NEAR(chain.joints[0].encoder_step, 1.5707963267948966e-5, 1e-18);
}

TEST(RobotToml, StandardAndModifiedNumbersOfOneArmGiveTheSameTorque) {
  test::TemporaryFolder const folder;
  std::string const link = "mass_kg = 2.0\ninertia_kgm2 = [0.02, 0.0, 0.0, 0.03, 0.0, 0.04]\n";
  // the second link's frames differ by Tx(0.3): its centre is at x = -0.1 in the standard one, 0.2 in the modified one
  auto const standard =
      folder.write("standard.toml",
                   "[robot]\nconvention = \"standard_dh\"\n[[joint]]\nalpha_rad = 1.5707963267948966\n" + link +
                       "centre_m = [0.0, 0.1, 0.0]\n[[joint]]\na_m = 0.3\n" + link + "centre_m = [-0.1, 0.0, 0.0]\n");
  // the first link's standard frame is the modified one turned about x by a right angle: y there is z here
  auto const modified = folder.write(
      "modified.toml",
      "[robot]\nflange_m = [0.3, 0, 0]\n[[joint]]\nmass_kg = 2.0\ninertia_kgm2 = [0.02, 0.0, 0.0, 0.04, 0.0, 0.03]\n"
      "centre_m = [0.0, 0.0, 0.1]\n[[joint]]\nalpha_rad = 1.5707963267948966\n" +
          link + "centre_m = [0.2, 0.0, 0.0]\n");
  auto const a = read_robot(standard), b = read_robot(modified);
  Eigen::Vector2d const q(0.3, -0.8), dq(1.1, 0.4), ddq(-2.0, 3.0);
  auto const torque = [&](SerialChain const& chain) {
    return inverse_dynamics(chain, standard_parameters(chain, DriveInertias::left_out), q, dq, ddq);
  };
  EXPECT_LT((torque(a) - torque(b)).norm(), 1e-13);
  EXPECT_LT((a.flange.position - b.flange.position).norm(), 1e-15);
}

TEST(RobotToml, AnAngleWrittenAsARoundedRightOneIsOneAndSaysSo) {
  test::TemporaryFolder const folder;
  auto const chain = read_robot(folder.write("a.toml", "[robot]\n[[joint]]\n[[joint]]\nalpha_rad = 1.57\n"));
  EXPECT_EQ(chain.joints[1].alpha, std::numbers::pi / 2.0);
  EXPECT_THAT(chain.remarks, testing::ElementsAre(testing::HasSubstr("right angle")));
}

struct Wrong {
  char const* text;
  char const* what;  // words of the problem
  char const* help;
  int line;
};

class WrongRobotToml : public testing::TestWithParam<Wrong> {};

TEST_P(WrongRobotToml, GivesPlaceAndCure) {
  test::TemporaryFolder const folder;
  try {
    read_robot(folder.write("wrong.toml", GetParam().text));
    FAIL() << "was read";
  } catch (Error const& error) {
    auto const& problem = error.problems().front();
    EXPECT_THAT(problem.what, testing::HasSubstr(GetParam().what));
    EXPECT_THAT(problem.help + problem.caret_note, testing::HasSubstr(GetParam().help));
    EXPECT_EQ(problem.place.line, GetParam().line);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongRobotToml,
    testing::Values(
        Wrong{"[robot]\n[[joint]]\nalpha_rad = 90\n", "is it in degrees?", "90 degrees are 1.57079", 3},
        Wrong{"[robot]\n[[joint]]\nlower = -175\nupper = 175\n", "is it in degrees?", "degrees are -3.05", 3},
        Wrong{"[robot]\n[[joint]]\na_m = 612.7\n", "a_m", "20", 3},
        Wrong{"[robot]\n[[joint]]\ntype = \"ball\"\n", "type", "revolute", 3},
        Wrong{"[robot]\n[[joint]]\nalfa_rad = 1.0\n", "unknown key \"alfa_rad\"", "alpha_rad", 3},
        Wrong{"[robot]\n[[joint]]\nname = \"a\"\n[[joint]]\nname = \"a\"\n", "two joints are called \"a\"", "own", 5},
        Wrong{"[robot]\n[[joint]]\nmass_kg = 1.0\ncentre_m = [0, 0, 0.0]\ninertia_kgm2 = [1, 0, 0, 1, 0, 1.0]\n"
              "[[joint]]\nname = \"hand\"\n",
              "joint \"hand\" has no mass", "for none", 6},
        Wrong{"[robot]\n[[joint]]\nmass_kg = 1.0\n", "not both", "write all three", 3},
        Wrong{"[robot]\n[[joint]]\nmass_kg = 1.0\ncentre_m = [0, 0, 0.0]\ninertia_kgm2 = [1, 0, 0, 1, 0, 3.0]\n",
              "triangle inequality", "centre of mass", 5},
        Wrong{"[robot]\ngravity = [0, 9.81]\n[[joint]]\n", "gravity holds 2 numbers", "[x, y, z]", 2},
        Wrong{"[robot]\nname = \"none\"\n", "no joint", "[[joint]]", 1},
        Wrong{"[robot]\n[[joint]]\n[link]\n", "no section [link]", "[[joint]]", 3},
        Wrong{"[robot]\n[[joint]]\nlower = 1.0\nupper = -1.0\n", "is not below", "exchange", 4},
        Wrong{"[robot]\n[[joint]]\na_m = \n", "this is not TOML", "TOML", 3},
        Wrong{"joints = 6\n", "describes no robot", "jobs/robots", 0}));

}  // namespace robot_toml_test
}  // namespace torquescope
