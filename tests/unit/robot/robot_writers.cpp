// Arms that are written and read again.

#include "engine/robot/robot_writers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/robot_registry.hpp"
#include "support/temporary_folder.hpp"
#include "unit/robot/example_arms.hpp"
#if defined(TORQUESCOPE_MUJOCO)
#include "unit/robot/mujoco_model.hpp"
#endif

namespace torquescope {
namespace robot_writers_test {

std::string written(std::string const& writer, SerialChain const& chain, std::vector<std::string> const& notes = {}) {
  for (auto const& one : robot_writers())
    if (one.name == writer) return one.write(chain, notes);
  ADD_FAILURE() << "no writer " << writer;
  return "";
}

SerialChain read_again(std::string const& writer, SerialChain const& chain) {
  test::TemporaryFolder const folder;
  return read_robot(folder.write("arm." + writer, written(writer, chain)));
}

// with names, limits, gears and a gravity of 9.81, as a file has them
test::RandomArm arm_of_a_file(std::uint32_t number) {
  auto arm = test::random_arm(number, number % 2 == 0);
  arm.chain.name = "arm <" + std::to_string(number) + "> & \"more\" -- of it";
  arm.chain.gravity *= 9.81 / arm.chain.gravity.norm();
  for (std::size_t i = 0; i < arm.chain.joints.size(); ++i) {
    auto& joint = arm.chain.joints[i];
    joint.name = "joint_" + std::to_string(i + 1);
    joint.gear_ratio = 100.0 + static_cast<double>(i);
    joint.encoder_step = 1.0 / 4096.0 / 7.0;
    if (i % 2 == 1) continue;
    joint.lower = -1.0 / 3.0;
    joint.upper = 2.0 / 3.0;
    joint.max_speed = 2.2;
    joint.max_torque = 87.0;
  }
  return arm;
}

Eigen::VectorXd torque(SerialChain const& chain, test::RandomArm const& at) {
  auto const chi = standard_parameters(chain, DriveInertias::included);
  return inverse_dynamics(chain, chi, at.q, at.dq, at.ddq);
}

void expect_same_limits(SerialChain const& chain, SerialChain const& again) {
  ASSERT_EQ(again.joints.size(), chain.joints.size());
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    EXPECT_EQ(again.joints[i].name, chain.joints[i].name);
    EXPECT_EQ(again.joints[i].kind, chain.joints[i].kind);
    if (chain.joints[i].kind == JointKind::revolute) {
      EXPECT_EQ(again.joints[i].lower, chain.joints[i].lower);
      EXPECT_EQ(again.joints[i].upper, chain.joints[i].upper);
    }
    EXPECT_EQ(again.joints[i].max_speed, chain.joints[i].max_speed);
    EXPECT_EQ(again.joints[i].max_torque, chain.joints[i].max_torque);
  }
}

TEST(RobotWriters, TomlReadAgainIsTheSameArm) {
  for (std::uint32_t number = 0; number < 60; ++number) {
    auto const arm = arm_of_a_file(number);
    auto const again = read_again("toml", arm.chain);
    expect_same_limits(arm.chain, again);
    EXPECT_EQ(again.name, arm.chain.name);
    auto const tau = torque(arm.chain, arm);
    EXPECT_LT((torque(again, arm) - tau).norm(), 1e-12 * tau.norm()) << number;
    for (std::size_t i = 0; i < arm.chain.joints.size(); ++i) {
      EXPECT_EQ(again.joints[i].gear_ratio, arm.chain.joints[i].gear_ratio);
      EXPECT_NEAR(again.joints[i].encoder_step, arm.chain.joints[i].encoder_step, 1e-18);
    }
  }
}

TEST(RobotWriters, UrdfReadAgainHasTheSameTorque) {
  for (std::uint32_t number = 0; number < 60; ++number) {
    auto arm = arm_of_a_file(number);
    auto again = read_again("urdf", arm.chain);
    expect_same_limits(arm.chain, again);
    for (std::size_t i = 0; i < arm.chain.joints.size(); ++i)  // a URDF has none
      again.joints[i].drive_inertia = arm.chain.joints[i].drive_inertia;
    auto const tau = torque(arm.chain, arm);
    EXPECT_LT((torque(again, arm) - tau).norm(), 1e-9 * tau.norm()) << number;
  }
}

TEST(RobotWriters, AnUnknownLimitIsNoZeroAndWhatIsLostIsSaid) {
  auto arm = arm_of_a_file(4);
  arm.chain.joints[0].max_torque = ChainJoint::no_limit;
  auto const urdf = written("urdf", arm.chain);
  EXPECT_THAT(urdf, testing::Not(testing::HasSubstr("effort=\"0\"")));
  EXPECT_THAT(urdf, testing::HasSubstr("that limit is not known"));
  EXPECT_THAT(urdf, testing::HasSubstr("joint \"joint_1\": gear_ratio = 100, drive_inertia = "));
  EXPECT_THAT(written("mjcf", arm.chain), testing::HasSubstr("joint \"joint_1\": gear_ratio = 100, encoder_counts"));
}

TEST(RobotWriters, UrdfOfAnArmWithoutMassesIsOneWithoutMasses) {
  auto chain = test::panda();
  for (std::size_t i = 0; i < chain.joints.size(); ++i) chain.joints[i].name = "joint_" + std::to_string(i + 1);
  EXPECT_FALSE(read_again("urdf", chain).has_inertias());
  EXPECT_FALSE(read_again("toml", chain).has_inertias());
}

TEST(RobotWriters, JsonIsJsonWithAllNumbers) {
  auto const arm = arm_of_a_file(3);
  auto const json = nlohmann::json::parse(written("json", arm.chain, {"two\nlines", "a \\ and a \""}));
  EXPECT_EQ(json["name"], arm.chain.name);
  EXPECT_EQ(json["notes"][0], "two\nlines");
  EXPECT_EQ(json["notes"][1], "a \\ and a \"");
  for (std::size_t i = 0; i < arm.chain.joints.size(); ++i) {
    auto const& joint = json["joints"][i];
    EXPECT_EQ(joint["alpha_rad"].get<double>(), arm.chain.joints[i].alpha);
    EXPECT_EQ(joint["about_frame"]["xx"].get<double>(), arm.chain.links[i].inertia(0, 0));
    EXPECT_EQ(joint["mass_kg"].get<double>(), arm.chain.links[i].mass);
    EXPECT_EQ(joint.contains("upper"), i % 2 == 0);
  }
}

TEST(RobotWriters, SayWhatTheyAreToldInEveryFormat) {
  auto const arm = arm_of_a_file(5);
  for (auto const& writer : robot_writers())
    EXPECT_THAT(writer.write(arm.chain, {"mass of link 1 is chosen"}), testing::HasSubstr("mass of link 1 is chosen"))
        << writer.name;
}

#if defined(TORQUESCOPE_MUJOCO)
TEST(RobotWriters, MjcfHasTheSameTorqueInMujoco) {
  for (std::uint32_t number = 0; number < 60; ++number) {
    auto const arm = arm_of_a_file(number);
    auto const tau = torque(arm.chain, arm);
    auto const theirs = test::MujocoModel::of_xml(written("mjcf", arm.chain)).inverse_dynamics(arm.q, arm.dq, arm.ddq);
    EXPECT_LT((theirs - tau).norm(), 1e-9 * tau.norm()) << number;
  }
}
#endif

}  // namespace robot_writers_test
}  // namespace torquescope
