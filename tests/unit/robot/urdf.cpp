// Robot files in URDF: frames, merged links, and wrong files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "engine/robot/base_parameters.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/robot_registry.hpp"
#include "support/temporary_folder.hpp"
#if defined(TORQUESCOPE_MUJOCO)
#include "unit/robot/mujoco_model.hpp"
#endif

namespace torquescope {
namespace urdf_test {

std::string inertial(double mass, std::string const& centre, std::string const& turn = "0 0 0") {
  auto const m = std::to_string(mass);
  return "<inertial><origin xyz='" + centre + "' rpy='" + turn + "'/><mass value='" + m +
         "'/><inertia ixx='0.03' ixy='0.002' ixz='-0.001' iyy='0.04' iyz='0.003' izz='0.02'/></inertial>";
}

std::string joint(std::string const& name, std::string const& type, std::string const& parent, std::string const& child,
                  std::string const& xyz, std::string const& rpy, std::string const& rest = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child +
         "'/><origin xyz='" + xyz + "' rpy='" + rpy + "'/>" + rest + "</joint>\n";
}

std::string const limit = "<limit lower='-2' upper='2' effort='50' velocity='3'/>";

// oblique and parallel axes, a slide, a continuous joint, masses on fixed links within, beside and behind the arm
std::string arm() {
  return "<?xml version='1.0'?>\n<robot name='crooked'>\n<link name='base'/>\n<link name='post'/>\n"
         "<link name='a'>" +
         inertial(4.0, "0.02 0 0.1") +
         "</link>\n"
         "<link name='b'>" +
         inertial(3.0, "0.1 0.02 0", "0.3 0.2 -0.1") +
         "</link>\n"
         "<link name='cover'>" +
         inertial(0.7, "0 0.05 0") +
         "</link>\n"
         "<link name='c'>" +
         inertial(2.0, "0 0.04 0.1") +
         "</link>\n"
         "<link name='d'/>\n<link name='bracket'>" +
         inertial(1.0, "0.03 0 0.02") +
         "</link>\n"
         "<link name='e'>" +
         inertial(0.8, "0 0 0.05") +
         "</link>\n"
         "<link name='tool'/>\n" +
         joint("stand", "fixed", "base", "post", "0.1 0.2 0.3", "0.1 0 0.4") +
         joint("j1", "revolute", "post", "a", "0 0 0.2", "0 0 0", "<axis xyz='0 0 1'/>" + limit) +
         joint("j2", "continuous", "a", "b", "0.1 -0.05 0.3", "1.57079632679 0 0.2", "<axis xyz='0 0.6 0.8'/>") +
         joint("lid", "fixed", "b", "cover", "0.1 0 0.1", "0 0.5 0") +
         joint("j3", "revolute", "b", "c", "0.4 0 0.02", "0 0 0", "<axis xyz='0 0.6 0.8'/>" + limit) +
         joint("j4", "prismatic", "c", "d", "0 0.1 0.1", "0.4 -0.3 0.2", "<axis xyz='0 -1 0'/>" + limit) +
         joint("mount", "fixed", "d", "bracket", "0 0.1 0", "0 0 1") +
         joint("j5", "revolute", "bracket", "e", "0.05 0 0.1", "0 1.2 0", "<axis xyz='1 0 0'/>" + limit) +
         joint("flange", "fixed", "e", "tool", "0 0 0.12", "0 0 0.5") + "</robot>\n";
}

SerialChain read(std::string const& text) {
  test::TemporaryFolder const folder;
  return read_robot(folder.write("robot.urdf", text));
}

Eigen::Isometry3d turn_and_move(double x, double y, double z, double roll, double pitch, double yaw) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(x, y, z));
  pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
              Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()));
  return pose;
}

TEST(Urdf, ToolIsWhereItsTransformsPutIt) {
  auto const chain = read(arm());
  ASSERT_EQ(chain.size(), 5);
  Eigen::Vector3d const oblique(0.0, 0.6, 0.8);
  for (double const scale : {0.0, 0.4, -1.3}) {
    Eigen::VectorXd q(5);
    q << 0.9, -1.1, 0.5, 0.3, 1.4;
    q *= scale;
    Eigen::Isometry3d expected = turn_and_move(0.1, 0.2, 0.3, 0.1, 0, 0.4) * turn_and_move(0, 0, 0.2, 0, 0, 0) *
                                 Eigen::AngleAxisd(q[0], Eigen::Vector3d::UnitZ());
    expected = expected * turn_and_move(0.1, -0.05, 0.3, 1.5707963267948966, 0, 0.2) * Eigen::AngleAxisd(q[1], oblique);
    expected = expected * turn_and_move(0.4, 0, 0.02, 0, 0, 0) * Eigen::AngleAxisd(q[2], oblique);
    expected = expected * turn_and_move(0, 0.1, 0.1, 0.4, -0.3, 0.2) * Eigen::Translation3d(0, -q[3], 0);
    expected = expected * turn_and_move(0, 0.1, 0, 0, 0, 1) * turn_and_move(0.05, 0, 0.1, 0, 1.2, 0) *
               Eigen::AngleAxisd(q[4], Eigen::Vector3d::UnitX()) * turn_and_move(0, 0, 0.12, 0, 0, 0.5);
    FramePose tool = chain.base;
    for (Eigen::Index i = 0; i < 5; ++i) tool = tool * joint_pose(chain.joints[static_cast<std::size_t>(i)], q[i]);
    tool = tool * chain.flange;
    EXPECT_LT((tool.position - expected.translation()).norm(), 1e-11);
    EXPECT_LT((tool.rotation - expected.linear()).norm(), 1e-11);
  }
}

TEST(Urdf, KeepsLimitsKindsAndTheMassOfFixedLinks) {
  auto const chain = read(arm());
  EXPECT_EQ(chain.name, "crooked");
  EXPECT_EQ(chain.joints[0].upper, 2.0);
  EXPECT_EQ(chain.joints[0].max_torque, 50.0);
  EXPECT_EQ(chain.joints[1].upper, ChainJoint::no_limit);  // continuous
  EXPECT_EQ(chain.joints[3].kind, JointKind::prismatic);
  EXPECT_NEAR(chain.links[1].mass, 3.7, 1e-12);
  EXPECT_NEAR(chain.links[3].mass, 1.0, 1e-12);
  EXPECT_NEAR(chain.gravity.norm(), 9.81, 1e-12);
}

#if defined(TORQUESCOPE_MUJOCO)
TEST(Urdf, TorqueIsThatOfMujocosOwnReader) {
  auto const chain = read(arm());
  auto mujoco = test::MujocoModel::of_xml(arm());
  auto const chi = standard_parameters(chain, DriveInertias::left_out);
  for (double const scale : {0.3, 1.0, -0.7}) {
    Eigen::VectorXd q(5), dq(5), ddq(5);
    q << 0.9, -1.1, 0.5, 0.3, 1.4;
    dq << 1.0, -0.5, 1.5, 0.4, -2.0;
    ddq << -3.0, 2.0, 4.0, 1.0, 5.0;
    auto const expected = mujoco.inverse_dynamics(scale * q, dq, ddq);
    auto const tau = inverse_dynamics(chain, chi, scale * q, dq, ddq);
    // MuJoCo's reader rounds to single precision here and there
    EXPECT_LT((tau - expected).norm(), 1e-6 * expected.norm());
  }
}
#endif

// the base's own axis: the frames are those that a table of DH numbers would have
TEST(Urdf, OfAnUprightArmHasTheUsualNumbers) {
  auto const chain = read(
      "<robot name='scara'><link name='w'/><link name='a'/><link name='b'/><link name='c'/>" +
      joint("one", "continuous", "w", "a", "0 0 0.4", "0 0 0", "<axis xyz='0 0 1'/>") +
      joint("two", "continuous", "a", "b", "0.3 0 0", "0 0 0", "<axis xyz='0 0 1'/>") +
      joint("slide", "prismatic", "b", "c", "0.25 0 0", "3.14159 0 0", "<axis xyz='0 0 1'/>" + limit) + "</robot>");
  EXPECT_FALSE(chain.has_inertias());
  EXPECT_EQ(chain.base.position.norm(), 0.0);
  EXPECT_NEAR(chain.joints[1].a, 0.3, 1e-15);
  EXPECT_NEAR(chain.joints[2].a, 0.25, 1e-15);
  EXPECT_NEAR(std::abs(chain.joints[2].alpha), 3.141592653589793, 1e-15);
}

TEST(Urdf, ATipInAFileOfOnesOwnLeavesTheGripperOut) {
  test::TemporaryFolder const folder;
  std::string text = arm();
  std::string const fingers =
      "<link name='left'>" + inertial(0.1, "0 0 0") + "</link><link name='right'>" + inertial(0.1, "0 0 0") +
      "</link>" + joint("finger", "prismatic", "tool", "left", "0 0.03 0", "0 0 0", "<axis xyz='0 1 0'/>" + limit) +
      joint("follower", "prismatic", "tool", "right", "0 -0.03 0", "0 0 0",
            "<axis xyz='0 -1 0'/>" + limit + "<mimic joint='finger'/>");
  text.insert(text.find("</robot>"), fingers);
  folder.write("arm.urdf", text);
  auto const chain = read_robot(folder.write("arm.toml",
                                             "[robot]\nname = \"with a hand\"\nurdf = \"arm.urdf\"\ntip = "
                                             "\"tool\"\n[[joint]]\nname = \"j2\"\ngear_ratio = 50\n"));
  EXPECT_EQ(chain.size(), 5);
  EXPECT_NEAR(chain.links[4].mass, 1.0, 1e-12);  // the fingers are held still and weigh
  EXPECT_EQ(chain.joints[1].gear_ratio, 50.0);
  EXPECT_EQ(chain.name, "with a hand");
  EXPECT_THAT(chain.remarks, testing::Contains(testing::HasSubstr("\"finger\" is beside the arm")));
}

struct Wrong {
  std::string from, to;  // in the text of arm()
  char const* what;
  char const* help;
  char const* line;  // words of the line that is shown
};

class WrongUrdf : public testing::TestWithParam<Wrong> {};

TEST_P(WrongUrdf, GivesPlaceAndCure) {
  auto text = arm();
  auto const at = text.find(GetParam().from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, GetParam().from.size(), GetParam().to);
  try {
    read(text);
    FAIL() << "was read";
  } catch (Error const& error) {
    auto const& problem = error.problems().front();
    EXPECT_THAT(problem.what, testing::HasSubstr(GetParam().what));
    EXPECT_THAT(problem.help, testing::HasSubstr(GetParam().help));
    EXPECT_THAT(problem.place.line_text, testing::HasSubstr(GetParam().line));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongUrdf,
    testing::Values(
        Wrong{"<axis xyz='0 -1 0'/>", "<axis xyz='0 0 0'/>", "has length 0", "direction", "'j4'"},
        Wrong{"upper='2'", "upper='175'", "is it in degrees?", "degrees are 3.05", "'j1'"},
        Wrong{"rpy='0.1 0 0.4'", "rpy='0 0 90'", "is it in degrees?", "90 degrees are 1.570796", "'stand'"},
        Wrong{"xyz='0.1 0.2 0.3'", "xyz='100 200 300'", "is it in millimetres?", "300 mm are 0.3 m", "'stand'"},
        Wrong{"xyz='0.1 0.2 0.3'", "xyz='0.1 nan 0.3'", "nan", "check_urdf", "'stand'"},
        Wrong{"type='prismatic'", "type='floating'", "floats", "root = \"d\"", "'j4'"},
        Wrong{"type='prismatic'", "type='screw'", "no known type", "check_urdf", "'j4'"},
        Wrong{"<mass value='0.800000'/>", "<mass value='-1'/>", "link \"e\"", "mass in kg", "name='e'"},
        Wrong{"<mass value='0.800000'/>", "<mass value='0,8'/>", "mass", "check_urdf", "0,8"},
        Wrong{"<link name='c'>" + inertial(2.0, "0 0.04 0.1"), "<link name='c'>", "behind joint \"j3\" has a mass",
              "for no link", "'j3'"},
        Wrong{"</robot>", joint("loop", "fixed", "tool", "c", "0 0 0", "0 0 0") + "</robot>", "a loop",
              "take one of the two joints out", "'"},
        Wrong{"<parent link='c'/>", "<parent link='nobody'/>", "nobody", "check_urdf", "'j4'"},
        Wrong{"</robot>",
              "<link name='x'/>" + joint("side", "continuous", "a", "x", "0 0 0", "0 0 0", "<axis xyz='0 0 1'/>") +
                  "</robot>",
              "has branches", "tip", "'side'"},
        Wrong{"<axis xyz='1 0 0'/>", "<axis xyz='1 0 0'/><mimic joint='j3'/>", "follows \"j3\"", "tip", "'j5'"},
        Wrong{"</joint>", "</joynt>", "no URDF", "", ""}));

TEST(Urdf, AFollowerOfNobodyIsWarnedOf) {
  auto text = arm();
  text.insert(text.find("</robot>"), "<link name='x'/>" + joint("f", "continuous", "a", "x", "0 0 0", "0 0 0",
                                                                "<axis xyz='0 0 1'/><mimic joint='nobody'/>"));
  EXPECT_THAT(read(text).warnings, testing::ElementsAre(testing::HasSubstr("follows \"nobody\"")));
}

TEST(Urdf, AnAxisOfAnotherLengthIsADirection) {
  auto text = arm();
  std::string const unit = "<axis xyz='0 0.6 0.8'/>";
  for (auto at = text.find(unit); at != std::string::npos; at = text.find(unit, at + 1))
    text.replace(at, unit.size(), "<axis xyz='0 1.2 1.6'/>");
  auto const chain = read(text), same = read(arm());
  for (std::size_t i = 0; i < chain.joints.size(); ++i) EXPECT_NEAR(chain.joints[i].alpha, same.joints[i].alpha, 1e-12);
  EXPECT_THAT(chain.remarks, testing::Contains(testing::AllOf(testing::HasSubstr("robot.urdf:"),
                                                              testing::HasSubstr("\"j2\" has length 2"))));
}

TEST(Urdf, UnknownWordsAreWarnedOfWithTheirLineAndASuggestion) {
  auto text = arm();
  for (auto const& [from, to] : {std::pair<std::string, std::string>{"<axis xyz='0 0 1'/>", "<axic xyz='0 0 1'/>"},
                                 {"<origin xyz='0 0 0.2'", "<origin xyzz='0 0 0.2'"},
                                 {"effort='50'", "effort='50' stifness='1'"}})
    text.replace(text.find(from), from.size(), to);
  auto const chain = read(text);
  EXPECT_THAT(chain.warnings,
              testing::UnorderedElementsAre(
                  testing::AllOf(testing::HasSubstr("<axic> in <joint>"), testing::HasSubstr("did you mean \"axis\"")),
                  testing::AllOf(testing::HasSubstr("\"xyzz\" of <origin>"), testing::HasSubstr("\"xyz\"")),
                  testing::HasSubstr("\"stifness\" of <limit>")));
}

TEST(Urdf, ThatNestsWithoutEndIsRefusedBeforeItIsParsed) {
  std::string text = "<robot name='x'>";
  for (int i = 0; i < 100000; ++i) text += "<a>";
  EXPECT_THROW(read(text), Error);
}

}  // namespace urdf_test
}  // namespace torquescope
