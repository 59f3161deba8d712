// An arm's file: columns by joint, one clock, whose finding it is; and recordings cut in two.

#include "engine/data/arm_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/data/health/finding_text.hpp"
#include "engine/data/health/joined_findings.hpp"
#include "engine/data/health/make_arm_recording.hpp"
#include "engine/data/health/make_recording.hpp"
#include "engine/data/split_recording.hpp"
#include "sample_recording.hpp"

namespace torquescope {
namespace arm_recording_test {

using health_test::sample_table;
using testing::StartsWith;

Section const section{"recording", {}, {}};
std::vector<std::string> const names{"shoulder", "elbow"};

RecordingOptions arm_options() {
  RecordingOptions options;
  options.columns = {{"time", "t_s"}, {"position", "q{j}_rad"}, {"torque", "{name}_Nm"}};
  options.torque_per_unit = {2.0, 3.0};
  return options;
}

// two joints on one clock
RawTable arm_table() {
  RawTable table = sample_table(), elbow = sample_table({.seed = 2});
  table.names = {"t_s", "q1_rad", "shoulder_Nm", "q2_rad", "elbow_Nm"};
  table.columns = {table.columns[0], table.columns[1], table.columns[2], elbow.columns[1], elbow.columns[2]};
  return table;
}

Problem refused(RecordingOptions const& options) {
  try {
    joint_options(options, names, section);
  } catch (Error const& error) {
    return error.problems().front();
  }
  return {};
}

TEST(JointOptions, TurnAJointRoundWithItsTorque) {
  auto options = arm_options();
  options.joint_sign = {1.0, -1.0};
  options.zero = {0.5, -0.25};
  options.delay_s = {0.0, 0.01};
  auto const joints = joint_options(options, names, section);
  EXPECT_EQ(joints[0].position_per_unit, 1.0);
  EXPECT_EQ(joints[1].position_per_unit, -1.0);
  EXPECT_EQ(joints[1].torque_factor(), -3.0);
  EXPECT_EQ(joints[1].zero, std::vector{-0.25});
  EXPECT_EQ(joints[1].delay(), 0.01);
}

TEST(JointOptions, TakeColumnsInAnotherOrder) {
  auto options = arm_options();
  options.position_order = {2.0, 1.0};
  auto const positions = joint_options(options, names, section);
  EXPECT_EQ(positions[0].columns.at("position"), "q2_rad");
  EXPECT_EQ(positions[0].columns.at("torque"), "shoulder_Nm");
  options.position_order.clear();
  options.torque_order = {2.0, 1.0};
  auto const torques = joint_options(options, names, section);
  EXPECT_EQ(torques[0].columns.at("position"), "q1_rad");
  EXPECT_EQ(torques[0].columns.at("torque"), "elbow_Nm");
  EXPECT_EQ(torques[0].torque_factor(), 2.0);  // of the joint, not of the column
}

TEST(JointOptions, RefuseNumbersThatFitNoArm) {
  auto options = arm_options();
  options.joint_sign = {1.0, 0.5};
  EXPECT_THAT(refused(options).what, StartsWith("joint_sign holds another number"));
  options = arm_options();
  options.torque_order = {1.0, 1.0};
  EXPECT_THAT(refused(options).what, StartsWith("torque_order is no order of 2 joints"));
  options = arm_options();
  options.zero = {0.1, 0.2, 0.3};
  EXPECT_THAT(refused(options).what, StartsWith("zero has 3 numbers"));
  options = arm_options();
  options.delay_s = {0.1, 0.2, 0.3};
  EXPECT_THAT(refused(options).what, StartsWith("delay_s has 3 numbers"));
}

// zero in rad, after unit and sign
TEST(JointOptions, ZeroIsAddedToThePosition) {
  auto options = arm_options();
  auto const read = [&] {
    return make_arm_recording(arm_table(), joint_options(options, names, section), names, section);
  };
  Eigen::VectorXd const plain = read().joints[1].position;
  options.joint_sign = {1.0, -1.0};
  options.zero = {0.0, 0.25};
  Eigen::VectorXd const turned = read().joints[1].position;
  EXPECT_LT((turned - (0.25 - plain.array()).matrix()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(JointOptions, FillNumbersAndNames) {
  auto const options = joint_options(arm_options(), names, section);
  ASSERT_EQ(options.size(), 2u);
  EXPECT_EQ(options[1].columns.at("position"), "q2_rad");
  EXPECT_EQ(options[1].columns.at("torque"), "elbow_Nm");
  EXPECT_EQ(options[1].columns.at("time"), "t_s");
  EXPECT_EQ(options[0].torque_factor(), 2.0);
  EXPECT_EQ(options[1].torque_factor(), 3.0);
  auto one_number = arm_options();
  one_number.torque_per_unit = {5.0};
  one_number.columns["position"] = "q[{i}]";
  EXPECT_EQ(joint_options(one_number, names, section)[1].torque_factor(), 5.0);
  EXPECT_EQ(joint_options(one_number, names, section)[1].columns.at("position"), "q[1]");
}

TEST(JointOptions, RefuseOneColumnForAllAndWrongNumbers) {
  auto options = arm_options();
  options.columns["torque"] = "tau_Nm";
  EXPECT_EQ(refused(options).what, "torque = \"tau_Nm\" is one column, and the arm has 2 joints");
  options = arm_options();
  options.torque_per_unit = {1.0, 2.0, 3.0};
  EXPECT_EQ(refused(options).what, "torque_per_unit has 3 numbers, and the arm has 2 joints");
}

TEST(ArmRecording, HasJointsOnOneClock) {
  auto const table = arm_table();
  auto const arm = make_arm_recording(table, joint_options(arm_options(), names, section), names, section);
  ASSERT_EQ(arm.joints.size(), 2u);
  EXPECT_EQ(arm.joints[0].time_s, arm.joints[1].time_s);
  EXPECT_EQ(arm.joints[1].position[7], table.columns[3][7]);
  EXPECT_EQ(arm.joints[1].torque[7], 3.0 * table.columns[4][7]);
  for (auto const& joint : arm.joints)
    for (auto const& finding : joint.findings) EXPECT_NE(finding.kind, FindingKind::other_joints_move);
}

TEST(ArmRecording, FindingsSayWhoseTheyAre) {
  auto table = arm_table();
  for (std::size_t row = 900; row < table.columns[3].size(); ++row) table.columns[3][row] += 0.35;
  auto const arm = make_arm_recording(table, joint_options(arm_options(), names, section), names, section);
  EXPECT_TRUE(arm.joints[0].findings.empty());
  ASSERT_FALSE(arm.joints[1].findings.empty());
  EXPECT_EQ(arm.joints[1].findings.front().kind, FindingKind::position_jumps);
  EXPECT_EQ(arm.joints[1].findings.front().joint, "joint 2 (elbow)");
  EXPECT_EQ(arm.joints[1].findings.front().column, "q2_rad");
  EXPECT_THAT(sentence_of(arm.joints[1].findings.front()), StartsWith("joint 2 (elbow): "));
}

TEST(JoinedFindings, SayOnceWhatJointsHaveAlikeAndKeepTheWorst) {
  auto const of = [](std::string joint, std::int64_t count, FindingKind kind = FindingKind::rows_repeated) {
    Finding finding{.kind = kind, .grade = Grade::warning, .repair = Repair::filled, .recording = "arm.csv"};
    finding.joint = std::move(joint);
    finding.count = count;
    return finding;
  };
  auto wrapped = of("joint 2", 5, FindingKind::position_wraps);
  wrapped.size = 3.0;
  auto otherwise = wrapped;  // another cure: another line
  otherwise.joint = "joint 3";
  otherwise.size = 4.0;
  auto const joined = joined_findings(
      {of("joint 1", 7), of("joint 2", 9), wrapped, of("joint 3", 9), otherwise, of("", 20), of("", 20)});
  ASSERT_EQ(joined.size(), 5u);
  EXPECT_EQ(joined[0].count, 9);
  EXPECT_EQ(joined[0].joint, "joint 2");
  EXPECT_EQ(joined[0].likewise, (std::vector<std::string>{"joint 1", "joint 3"}));
  EXPECT_THAT(sentence_of(joined[0]), StartsWith("joint 2 (likewise joint 1, joint 3): rows repeat"));
  EXPECT_TRUE(joined[1].likewise.empty());
  EXPECT_TRUE(joined[3].joint.empty());  // of the whole recording
}

TEST(ArmRecording, WhatAllJointsShareIsSaidOnce) {
  auto table = arm_table();
  table.remarks = {"the reader did something"};
  auto const arm = make_arm_recording(table, joint_options(arm_options(), names, section), names, section);
  EXPECT_EQ(arm.joints[0].findings.size(), 1u);
  EXPECT_TRUE(arm.joints[1].findings.empty());
}

// a joint that goes on while the logger misses rows makes no jump
TEST(PositionExamination, MissingRowsAreNoJump) {
  auto table = sample_table({500, 12, 0.9, 0.0, 0.02, 5});
  std::size_t const first = 1300, count = 8;
  for (auto& column : table.columns) column.erase(column.begin() + first, column.begin() + first + count);
  table.line_of_row.resize(table.columns[0].size());
  auto const recording = make_recording(table, health_test::sample_options(), section);
  for (auto const& finding : recording.findings) EXPECT_NE(finding.kind, FindingKind::position_jumps);
}

// an encoder that flickers between neighbouring steps is no second source, and no jump
TEST(PositionExamination, AStandingJointStandsAndNothingElse) {
  auto table = sample_table({100, 10, 0.9, 0.0, 0.02, 5});
  for (std::size_t row = 0; row < table.columns[1].size(); ++row)
    table.columns[1][row] = 1e-4 * static_cast<double>(row * row / 7 % 3 == 0);
  auto flickers_seldom = table;
  for (std::size_t row = 0; row < table.columns[1].size(); ++row)
    flickers_seldom.columns[1][row] = 1e-4 * static_cast<double>(row > 400 && row < 404);
  for (auto const& one : {table, flickers_seldom}) {
    auto const recording = make_recording(one, health_test::sample_options(), section);
    ASSERT_EQ(recording.findings.size(), 1u);
    EXPECT_EQ(recording.findings.front().kind, FindingKind::standstill);
  }
}

TEST(SplitRecording, SharesNoSampleAndKeepsStretches) {
  auto whole = make_recording(sample_table({.rate_hz = 100, .seconds = 10}), health_test::sample_options(), section);
  whole.left_out = {{6.0, 8.0}};
  auto const [head, tail] = split_recording(whole, 0.7);
  EXPECT_EQ(head.position.size(), 700);
  EXPECT_EQ(tail.position.size(), 300);
  EXPECT_EQ(tail.position[0], whole.position[700]);
  EXPECT_EQ(tail.name, "sample.csv (7 to 10 s)");
  ASSERT_EQ(head.left_out.size(), 1u);
  EXPECT_NEAR(head.left_out[0].until_s, 7.0, 1e-9);
  EXPECT_NEAR(tail.left_out[0].from_s, 0.0, 1e-9);
  EXPECT_NEAR(tail.left_out[0].until_s, 1.0, 1e-9);
}

TEST(JointTitle, SaysTheNumberOnce) {
  EXPECT_EQ(joint_title(1, names), "joint 2 (elbow)");
  EXPECT_EQ(joint_title(0, {"joint_1"}), "joint_1");
  EXPECT_EQ(joint_title(0, {""}), "joint 1");
}

}  // namespace arm_recording_test
}  // namespace torquescope
