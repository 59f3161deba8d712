// Robot files in MJCF against closed forms, against what our own writer makes, and wrong files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/robot_registry.hpp"
#include "engine/robot/robot_writers.hpp"
#include "support/temporary_folder.hpp"
#include "unit/robot/example_arms.hpp"
#include "unit/robot/small_robots.hpp"
#if defined(TORQUESCOPE_MUJOCO)
#include "unit/robot/mujoco_model.hpp"
#endif

namespace torquescope {
namespace mjcf_test {

constexpr double pi = std::numbers::pi;

SerialChain read(std::string const& text, RobotPart const& part = {}) {
  test::TemporaryFolder const folder;
  return read_robot(folder.write("robot.xml", text), part);
}

std::string model(std::string const& bodies, std::string const& before = "<compiler angle='radian'/>",
                  std::string const& after = "") {
  return "<mujoco model='small'>\n" + before + "\n<worldbody>\n" + bodies + "\n</worldbody>\n" + after + "</mujoco>\n";
}

Eigen::VectorXd torque(SerialChain const& chain, Eigen::VectorXd const& q, Eigen::VectorXd const& dq,
                       Eigen::VectorXd const& ddq) {
  return inverse_dynamics(chain, standard_parameters(chain, DriveInertias::included), q, dq, ddq);
}

// frame of the tool, seen from the file's base
Eigen::Isometry3d tool(SerialChain const& chain, Eigen::VectorXd const& q) {
  FramePose pose = chain.base;
  for (Eigen::Index i = 0; i < q.size(); ++i) pose = pose * joint_pose(chain.joints[static_cast<std::size_t>(i)], q[i]);
  pose = pose * chain.flange;
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = pose.rotation;
  result.translation() = pose.position;
  return result;
}

TEST(Mjcf, TorqueOfAPendulumIsItsClosedForm) {
  auto const chain =
      read(model("<body name='rod' pos='0 0 1'><joint name='hinge' axis='0 2 0' armature='0.3' range='-1 2'/>"
                 "<inertial mass='2' pos='0.5 0 0' diaginertia='0.01 0.04 0.04'/></body>",
                 "<compiler angle='radian'/><option gravity='0 0 -10'/>"));
  ASSERT_EQ(chain.size(), 1);
  Eigen::VectorXd q(1), dq(1), ddq(1);
  q << 0.4;
  dq << 3.0;
  ddq << 2.0;
  double const expected = (0.3 + 0.04 + 2.0 * 0.25) * 2.0 - 2.0 * 10.0 * 0.5 * std::cos(0.4);
  EXPECT_NEAR(torque(chain, q, dq, ddq)[0], expected, 1e-12);
  EXPECT_EQ(chain.joints[0].lower, -1.0);
  EXPECT_EQ(chain.joints[0].upper, 2.0);
  EXPECT_EQ(chain.joints[0].drive_inertia, 0.3);
}

struct Orientation {
  char const* compiler;
  char const* written;
  Eigen::Matrix3d expected;
};

Eigen::Matrix3d about(Eigen::Vector3d const& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

TEST(Mjcf, OrientationsAreThoseOfTheReference) {
  Eigen::Vector3d const x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d axes;
  axes << 0.6, -0.8, 0.0, 0.8, 0.6, 0.0, 0.0, 0.0, 1.0;
  Orientation const cases[] = {
      {"", "euler='20 30 40'", about(x, pi / 9) * about(y, pi / 6) * about(z, 2 * pi / 9)},
      {"angle='radian' eulerseq='zyx'", "euler='0.1 0.2 0.3'", about(z, 0.1) * about(y, 0.2) * about(x, 0.3)},
      {"angle='radian' eulerseq='XYZ'", "euler='0.1 0.2 0.3'", about(z, 0.3) * about(y, 0.2) * about(x, 0.1)},
      {"", "axisangle='0 3 4 50'", about({0, 3, 4}, 5 * pi / 18)},
      {"", "quat='2 0.4 0.6 -0.2'", Eigen::Quaterniond(2, 0.4, 0.6, -0.2).normalized().toRotationMatrix()},
      {"", "xyaxes='3 4 0 1 9 0'", axes},
      {"", "zaxis='1 0 1'", about(y, pi / 4)},
      {"", "zaxis='0 0 -2'", about(x, pi)},
  };
  for (auto const& one : cases) {
    auto const chain = read(model("<body name='a'><joint axis='0 0 1'/><body name='b' pos='0.1 0.2 0.3' " +
                                      std::string(one.written) + "/></body>",
                                  "<compiler " + std::string(one.compiler) + "/>"),
                            {"", "b"});
    auto const found = tool(chain, Eigen::VectorXd::Zero(1));
    EXPECT_LT((found.linear() - one.expected).norm(), 1e-12) << one.written;
    EXPECT_LT((found.translation() - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 1e-12) << one.written;
  }
}

TEST(Mjcf, SeveralJointsOfABodyActFromTheOutsideIn) {
  auto const chain = read(
      model("<body name='a' pos='0 0 1' euler='0 0 0.3'><joint name='one' axis='1 0 0' pos='0 0.1 0'/>"
            "<joint name='two' type='slide' axis='0 0 1'/><joint name='three' axis='0 1 0' pos='0.2 0 0' ref='0.5'/>"
            "<geom type='box' size='0.1 0.2 0.3'/></body>"));
  ASSERT_EQ(chain.size(), 3);
  Eigen::VectorXd q(3), zero = Eigen::VectorXd::Zero(3);
  q << 0.7, 0.4, -0.6;
  auto const around = [](Eigen::Vector3d const& point, Eigen::Vector3d const& axis, double angle) {
    return Eigen::Translation3d(point) * Eigen::AngleAxisd(angle, axis) * Eigen::Translation3d(-point);
  };
  Eigen::Isometry3d const expected = Eigen::Translation3d(0, 0, 1) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) *
                                     around({0, 0.1, 0}, Eigen::Vector3d::UnitX(), 0.7) *
                                     Eigen::Translation3d(0, 0, 0.4) *
                                     around({0.2, 0, 0}, Eigen::Vector3d::UnitY(), -0.6 - 0.5);
  EXPECT_LT((tool(chain, q).matrix() - expected.matrix()).norm(), 1e-12);
  // the slide lifts all of it: 48 kg
  EXPECT_EQ(chain.links[0].mass, 0.0);
  EXPECT_NEAR(torque(chain, zero, zero, zero)[1], 48.0 * 9.81, 1e-9);
}

struct Geom {
  char const* written;
  double mass, across, along;  // about the centre, along x and z
};

TEST(Mjcf, InertiasOfGeomsAreThoseOfSolids) {
  double const ball = 1000.0 * 4.0 / 3.0 * pi * 0.001, rod = 1000.0 * pi * 0.01 * 0.6;
  double const ends = ball * (0.4 * 0.01 + 0.3 * 0.3 + 0.75 * 0.3 * 0.1);
  Geom const geoms[] = {
      {"size='0.1'", ball, 0.4 * ball * 0.01, 0.4 * ball * 0.01},
      {"type='box' size='0.1 0.2 0.3' mass='3'", 3.0, 0.04 + 0.09, 0.01 + 0.04},
      {"type='cylinder' size='0.1 0.3'", rod, rod * (0.03 + 0.36) / 12.0, rod * 0.005},
      {"type='capsule' size='0.1 0.3'", rod + ball, rod * (0.03 + 0.36) / 12.0 + ends, rod * 0.005 + ball * 0.004},
      {"type='capsule' fromto='0 0 -0.3 0 0 0.3' size='0.1'", rod + ball, rod * (0.03 + 0.36) / 12.0 + ends,
       rod * 0.005 + ball * 0.004},
      {"type='ellipsoid' size='0.1 0.1 0.1' density='500'", 0.5 * ball, 0.2 * ball * 0.01, 0.2 * ball * 0.01},
  };
  for (auto const& geom : geoms) {
    auto const chain = read(model("<body><joint axis='0 0 1'/><geom " + std::string(geom.written) +
                                  "/><geom type='mesh' mesh='cover' mass='0'/></body>"));
    ASSERT_TRUE(chain.has_inertias()) << geom.written;
    EXPECT_NEAR(chain.links[0].mass, geom.mass, 1e-12 * geom.mass) << geom.written;
    EXPECT_NEAR(chain.links[0].inertia(0, 0), geom.across, 1e-12 * geom.across) << geom.written;
    EXPECT_NEAR(chain.links[0].inertia(2, 2), geom.along, 1e-12 * geom.along) << geom.written;
  }
}

TEST(Mjcf, AMeshWithoutInertialLeavesInertiasUnknownAndSaysSo) {
  auto const chain = read(model("<body><joint axis='0 0 1'/>\n<geom type='mesh' mesh='arm'/></body>"));
  EXPECT_FALSE(chain.has_inertias());
  EXPECT_THAT(chain.warnings,
              testing::ElementsAre(testing::AllOf(testing::HasSubstr("robot.xml:5"), testing::HasSubstr("type mesh"))));
}

TEST(Mjcf, ReadAgainFromOurWriterHasTheSameTorque) {
  for (std::uint32_t number = 0; number < 60; ++number) {
    auto arm = test::random_arm(number, number % 2 == 0);
    for (std::size_t i = 0; i < arm.chain.joints.size(); ++i) {
      arm.chain.joints[i].name = "joint_" + std::to_string(i + 1);
      if (i % 2 == 0) arm.chain.joints[i].lower = -1.0 / 3.0, arm.chain.joints[i].upper = 2.0 / 3.0;
    }
    std::string text;
    for (auto const& writer : robot_writers())
      if (writer.name == "mjcf") text = writer.write(arm.chain, {});
    auto const again = read(text);
    auto const tau = torque(arm.chain, arm.q, arm.dq, arm.ddq);
    EXPECT_LT((torque(again, arm.q, arm.dq, arm.ddq) - tau).norm(), 1e-9 * tau.norm()) << number;
    for (std::size_t i = 0; i < arm.chain.joints.size(); ++i) {
      EXPECT_EQ(again.joints[i].lower, arm.chain.joints[i].lower);
      EXPECT_EQ(again.joints[i].drive_inertia, arm.chain.joints[i].drive_inertia);
    }
  }
}

TEST(Mjcf, ClassesFramesAndIncludedFilesAreFollowed) {
  test::TemporaryFolder const folder;
  folder.write("classes.xml",
               "<mujocoinclude><default><joint armature='0.5'/><default class='a'><joint axis='1 0 0'/>"
               "<default class='b'><joint type='slide'/></default></default></default></mujocoinclude>");
  auto const chain = read_robot(folder.write(
      "arm.xml", model("<frame pos='0 0 1' childclass='a'><body><joint name='p'/><body><joint name='q' class='b'/>"
                       "<body childclass='main'><joint name='r' armature='0.1'/></body></body></body></frame>",
                       "<include file='classes.xml'/>")));
  ASSERT_EQ(chain.size(), 3);
  EXPECT_EQ(chain.joints[0].kind, JointKind::revolute);
  EXPECT_EQ(chain.joints[1].kind, JointKind::prismatic);
  EXPECT_EQ(chain.joints[1].drive_inertia, 0.5);
  EXPECT_EQ(chain.joints[2].drive_inertia, 0.1);
  EXPECT_NEAR(chain.base.rotation(0, 2), 1.0, 1e-15);  // z0 is the file's x
}

TEST(Mjcf, GearsAreRatiosUnlessTheControlIsNormalised) {
  std::string const body =
      "<body><joint name='j' axis='0 0 1'/><inertial mass='1' pos='0 0 0' diaginertia='1 1 1'/></body>";
  auto const with = [&](std::string const& actuator) {
    return read(model(body, "", "<actuator>" + actuator + "</actuator>")).joints[0];
  };
  EXPECT_EQ(with("<motor joint='j' gear='50' ctrlrange='-2 2'/>").gear_ratio, 50.0);
  EXPECT_EQ(with("<motor joint='j' gear='50' ctrlrange='-2 2'/>").max_torque, 100.0);
  EXPECT_EQ(with("<motor joint='j' gear='150' ctrlrange='-1 1'/>").gear_ratio, 1.0);
  EXPECT_EQ(with("<motor joint='j' gear='150' ctrlrange='-1 1'/>").max_torque, 150.0);
  EXPECT_EQ(with("<position joint='j' gear='-20' forcerange='-3 3'/>").gear_ratio, 20.0);
  EXPECT_EQ(with("<position joint='j' gear='-20' forcerange='-3 3'/>").max_torque, 60.0);
}

TEST(Mjcf, FilesOfTheUsualStructureAreRead) {
  auto const hand = read(test::hand_mjcf(), {"", "hand"});
  ASSERT_EQ(hand.size(), 7);
  EXPECT_EQ(hand.joints[0].max_torque, 87.0);
  EXPECT_NEAR(hand.links[6].mass, 4.0 - 2.8 + 0.73 + 0.03, 1e-12);  // the fingers are held and weigh
  auto const seven = read(test::seven_joint_mjcf());
  ASSERT_EQ(seven.size(), 7);
  EXPECT_NEAR(seven.joints[1].upper, 170.0 * pi / 180.0, 1e-12);
  auto const jaw = read(test::jaw_mjcf());
  ASSERT_EQ(jaw.size(), 6);
  EXPECT_EQ(jaw.joints[5].drive_inertia, 0.028);
  EXPECT_EQ(jaw.joints[5].max_torque, 3.35);
  EXPECT_THAT(jaw.remarks, testing::Contains(testing::HasSubstr("frictionloss 0.052")));
  auto const leg = read(test::quadruped_mjcf(), {"trunk", "RL_calf"});
  ASSERT_EQ(leg.size(), 3);
  EXPECT_EQ(leg.joints[0].name, "RL_hip_joint");
  EXPECT_EQ(leg.joints[0].max_torque, 23.7);
  for (auto const& chain : {hand, seven, jaw, leg}) EXPECT_THAT(chain.warnings, testing::IsEmpty());
}

TEST(Mjcf, ACouplingOfTheArmIsSaid) {
  auto const chain = read(test::hand_mjcf(), {"", "left"});
  EXPECT_THAT(chain.warnings, testing::ElementsAre(testing::HasSubstr("couples joint \"finger1\" to \"finger2\"")));
}

TEST(Mjcf, RadiansWithoutACompilerThatSaysSoAreDoubted) {
  std::string const body = "<body><joint range='-2.9 2.9' axis='0 0 1'/></body>";
  EXPECT_THAT(read(model(body, "")).warnings, testing::ElementsAre(testing::HasSubstr("angle=\"radian\"")));
  EXPECT_THAT(read(model(body, "<compiler angle='degree'/>")).warnings, testing::IsEmpty());
}

// every beginning of a file ends in an error or in an arm
TEST(Mjcf, FilesThatWereCutShortAreRefused) {
  auto const text = test::seven_joint_mjcf();
  test::TemporaryFolder const folder;
  for (std::size_t length = 1; length + 1 < text.size(); length += 7)
    EXPECT_THROW(read_robot(folder.write("robot.xml", text.substr(0, length))), Error) << length;
}

TEST(Mjcf, UnknownWordsAreWarnedOfWithTheirLine) {
  auto const chain = read(model("<body><joint axiss='1 0 0'/>\n<inertal mass='1'/><geom size='0.1'/></body>"));
  EXPECT_THAT(chain.warnings,
              testing::ElementsAre(testing::AllOf(testing::HasSubstr(":4:"), testing::HasSubstr("\"axis\"")),
                                   testing::AllOf(testing::HasSubstr(":5:"), testing::HasSubstr("\"inertial\""))));
}

struct Wrong {
  char const* bodies;
  char const* what;
  char const* help;
  int line;
};

class WrongMjcf : public testing::TestWithParam<Wrong> {};

TEST_P(WrongMjcf, GivesPlaceAndCure) {
  try {
    read(model(GetParam().bodies));
    FAIL() << "was read";
  } catch (Error const& error) {
    auto const& problem = error.problems().front();
    EXPECT_THAT(problem.what, testing::HasSubstr(GetParam().what));
    EXPECT_THAT(problem.help, testing::HasSubstr(GetParam().help));
    EXPECT_EQ(problem.place.line, GetParam().line);
    EXPECT_THAT(problem.place.file, testing::EndsWith("robot.xml"));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongMjcf,
    testing::Values(
        Wrong{"<body>\n<joint axis='0 0 0'/></body>", "length 0", "axis=\"0 0 1\"", 5},
        Wrong{"<body>\n<joint axis='0 0'/></body>", "not 3 numbers", "no comma", 5},
        Wrong{"<body>\n<joint range='-170 170'/></body>", "is it in degrees?", "degree", 5},
        Wrong{"<body>\n<joint type='hing'/></body>", "\"hing\"", "hinge", 5},
        Wrong{"<body>\n<joint class='x'/></body>", "class \"x\"", "classes", 5},
        Wrong{"<body>\n<joint name='a'/><joint name='a'/></body>", "called \"a\"", "of its own", 5},
        Wrong{"<body quat='1 0 0 0'\n euler='0 0 0'><joint/></body>", "2 orientations", "keep one", 4},
        Wrong{"<body>\n<joint/><inertial mass='1' diaginertia='1 1 1'/></body>", "mass and pos", "pos=", 5},
        Wrong{"<body>\n<joint/><inertial pos='0 0 0' mass='1'/></body>", "diaginertia", "kg m^2", 5},
        Wrong{"<body>\n<joint/><geom type='box'/></body>", "no volume", "half lengths", 5},
        Wrong{"<body pos='0 0 333'>\n<body pos='0 0 333'><joint/></body></body>", "millimetres", "0.333 m", 4},
        Wrong{"<replicate count='3'>\n<body><joint/></body></replicate>", "MuJoCo alone", "mj_saveLastXML", 4},
        Wrong{"<include file='there.xml'/>", "there is no file", "relative", 4},
        Wrong{"<body>\n<joint/></boddy>", "</boddy> closes <body> of line 4", "mend", 5},
        Wrong{"<body>\n</body>", "no joint", "revolute", 0}));

#if defined(TORQUESCOPE_MUJOCO)
TEST(Mjcf, TorqueIsThatOfMujocosOwnReader) {
  auto const chain = read(test::seven_joint_mjcf());
  auto mujoco = test::MujocoModel::of_xml(test::seven_joint_mjcf());
  Eigen::VectorXd const q = Eigen::VectorXd::LinSpaced(7, -1.0, 1.3), dq = Eigen::VectorXd::LinSpaced(7, 1.0, -0.4);
  // every joint of the file has a damping of 1 N m s/rad, which is no torque of the chain
  Eigen::VectorXd const expected = mujoco.inverse_dynamics(q, dq, 2.0 * dq) - 1.0 * dq;
  EXPECT_LT((torque(chain, q, dq, 2.0 * dq) - expected).norm(), 1e-9 * expected.norm());
}
#endif

}  // namespace mjcf_test
}  // namespace torquescope
