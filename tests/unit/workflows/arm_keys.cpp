// Keys of a job about an arm: coupled drives and effects of joints, and what is refused.

#include "engine/experiment/arm_keys.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace arm_keys_test {

Job job_of(std::string const& text) { return parse_job(text, "arm.toml"); }

std::string refused(std::string const& text, std::size_t joints = 3) {
  try {
    ArmTerms terms;
    read_joint_models(job_of(text), joints, terms);
    SerialChain chain;
    chain.joints.resize(joints);
    read_arm_effects(job_of(text), chain);
  } catch (Error const& error) {
    return error.problems().front().what;
  }
  return "";
}

TEST(ArmKeys, ARowOfTheTransmissionIsThatOfOneMotor) {
  ArmTerms terms;
  Eigen::MatrixXd const turns = read_joint_models(job_of("[model.joint_3]\nmotor_turns_by = [0, 0.5, 1]\n"), 3, terms);
  ASSERT_EQ(turns.rows(), 3);
  EXPECT_EQ(turns(2, 1), 0.5);
  EXPECT_EQ(turns(1, 1), 1.0);
  EXPECT_EQ(read_joint_models(job_of("[model.joint_3]\nmotor_turns_by = [0, 0, 1]\n"), 3, terms).size(), 0)
      << "its own joint alone: no drive is coupled";
}

TEST(ArmKeys, ARowOfAnotherLengthOrOfAnotherGearIsRefused) {
  EXPECT_EQ(refused("[model.joint_3]\nmotor_turns_by = [1, 1]\n"),
            "motor_turns_by has 2 numbers, and the arm has 3 joints");
  EXPECT_EQ(refused("[model.joint_3]\nmotor_turns_by = [0, 1, 2]\n"),
            "motor 3 turns by 2 of its own joint 3, not by 1");
}

TEST(ArmKeys, TorquesOfMotorsAreThoseOfCoupledOnes) {
  SerialChain chain;
  chain.joints.resize(2);
  RecordingOptions options;
  std::vector<Problem> problems;
  refuse_motor_torques({}, options, chain, problems);
  EXPECT_TRUE(problems.empty());
  options.torque_at = "motors";
  refuse_motor_torques({}, options, chain, problems);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "recording.torque_at");
  chain.transmission = Eigen::MatrixXd::Identity(2, 2);
  refuse_motor_torques({}, options, chain, problems);
  EXPECT_EQ(problems.size(), 1u);
}

TEST(ArmKeys, AnEffectHasAJointAndAllOfItsShapesOrNone) {
  SerialChain chain;
  chain.joints.resize(3);
  auto const effects = read_arm_effects(job_of("[[model.effects]]\njoint = 2\nname = \"stribeck\"\n"
                                               "stribeck_speed = 0.1\nstribeck_exponent = 2\n"),
                                        chain);
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_EQ(effects[0].joint, 1u);
  EXPECT_EQ(effects[0].shape, (std::vector<double>{0.1, 2.0}));
  std::string const begin = "[[model.effects]]\njoint = 2\n";
  EXPECT_EQ(refused("[[model.effects]]\nname = \"stribeck\"\n"), "an effect of an arm stands at one of its joints");
  EXPECT_EQ(refused(begin + "name = \"stribeck\"\nstribeck_speed = 0.1\n"), "stribeck has some of its shapes, not all");
  EXPECT_EQ(refused(begin + "name = \"delay\"\n"),
            "\"delay\" cannot stand beside an arm: it acts on a recorded channel, not in the joint");
  EXPECT_NE(refused(begin + "name = \"stribeck\"\nspeed = 0.1\n"), "");
}

}  // namespace arm_keys_test
}  // namespace torquescope
