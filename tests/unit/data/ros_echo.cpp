// Rows of `ros2 topic echo --csv`, as rosidl_runtime_py's message_to_csv writes them.

#include <cmath>

#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace ros_echo_test {

using data_test::problem_of;
using data_test::recording_section;
using data_test::write;
using Names = std::vector<std::string>;

RawTable read(std::string const& text) { return read_table(write("echo.csv", text), recording_section()); }

// which reader takes it
std::string reader_of(std::string const& text) {
  for (auto const& reader : reader_choices())
    if (reader.accepts("echo.csv", text)) return reader.name;
  return "";
}

TEST(RosEcho, JointsHaveTheirNamesAndOneStamp) {
  auto const table = read(
      "1768472944,999000000,base,elbow,wrist,0.5,1.5,-2.0,3.0,4e-05,5.0\n"
      "1768472945,1000000,base,elbow,wrist,0.25,nan,-2.5,3.5,4.5,5.5\n");
  EXPECT_EQ(table.names, (Names{"stamp.sec", "stamp.nanosec", "elbow/position", "wrist/position", "elbow/velocity",
                                "wrist/velocity", "elbow/effort", "wrist/effort", "stamp"}));
  EXPECT_EQ(table.columns[2], (std::vector<double>{0.5, 0.25}));
  EXPECT_TRUE(std::isnan(table.columns[3][1]));
  EXPECT_EQ(table.columns[6], (std::vector<double>{4e-05, 4.5}));
  EXPECT_NEAR(table.columns[8][1] - table.columns[8][0], 0.002, 1e-12);
  EXPECT_EQ(table.line_of_row, (std::vector<std::int64_t>{1, 2}));
}

// an empty list is an empty cell
TEST(RosEcho, ListsThatAreEmptyAreNoColumns) {
  EXPECT_EQ(read("1,0,,elbow,0.5,,2.5\n1,5,,elbow,0.75,,3.5\n").names,
            (Names{"stamp.sec", "stamp.nanosec", "elbow/position", "elbow/effort", "stamp"}));
  auto const table = read("1,0,,a,b,1,2,,\n1,5,,a,b,3,4,,\n");
  EXPECT_EQ(table.names, (Names{"stamp.sec", "stamp.nanosec", "a/position", "b/position", "stamp"}));
  ASSERT_EQ(table.unusable.size(), 4u);
  EXPECT_EQ(table.unusable[0].name, "a/velocity");
  EXPECT_EQ(table.unusable[0].reason, "is empty in every message");
  auto const later = read("1,0,,a,1,,\n1,5,,a,3,4,\n");
  EXPECT_TRUE(std::isnan(later.columns[3][0])) << "velocity";
  EXPECT_EQ(later.columns[3][1], 4);
}

// control_msgs/JointTrajectoryControllerState: three points, in newer versions four and what comes behind them
TEST(RosEcho, PointsOfAControllerHaveTheJointsNames) {
  std::string const desired = "0.5,1.5,,,,0,0", actual = "0.25,1.25,2.0,3.0,,7.0,8.0,0,5", error = "0.25,0.25,,,,0,0";
  std::string const begin = "1,0,base,elbow,wrist,";
  Names const names{"stamp.sec",
                    "stamp.nanosec",
                    "elbow/reference.position",
                    "wrist/reference.position",
                    "elbow/feedback.position",
                    "wrist/feedback.position",
                    "elbow/feedback.velocity",
                    "wrist/feedback.velocity",
                    "elbow/feedback.effort",
                    "wrist/feedback.effort",
                    "elbow/error.position",
                    "wrist/error.position",
                    "stamp"};
  auto const row = begin + desired + "," + actual + "," + error;
  auto const old = read(row + "\n" + row + "\n");
  EXPECT_EQ(old.names, names);
  EXPECT_EQ(old.columns[3], (std::vector<double>{1.5, 1.5}));
  EXPECT_EQ(old.columns[8], (std::vector<double>{7.0, 7.0}));
  auto const newer = row + ",,,,9.0,9.5,0,0,,,";
  auto const now = read(newer + "\n" + newer + "\n");
  EXPECT_EQ(now.names[12], "elbow/output.effort");
  EXPECT_EQ(now.columns[13], (std::vector<double>{9.5, 9.5}));
}

TEST(RosEcho, OtherMessagesAreNumbered) {
  auto const table = read("1,0,tool,1.5,-2.5,true\n1,5,tool,3.5,-4.5,true\n");
  EXPECT_EQ(table.names, (Names{"stamp.sec", "stamp.nanosec", "value[0]", "value[1]", "stamp"}));
  EXPECT_EQ(table.columns[3], (std::vector<double>{-2.5, -4.5}));
  ASSERT_EQ(table.unusable.size(), 2u);
  EXPECT_EQ(table.unusable[0].name, "frame_id");
  EXPECT_EQ(table.unusable[1].reason, "holds text: \"true\" in line 1");
}

TEST(RosEcho, WhatStandsBetweenIsLeftOutAndTold) {
  auto const table = read(
      "WARNING: topic [/joint_states] does not appear to be published yet\n"
      "1,0,base,elbow,1,2,3\n"
      "A message was lost!!!\n\ttotal count change:1\n\ttotal count: 1---\n"
      "1,2,gripper,finger,thumb,1,2,,\n"
      "1,5,base,elbow,4,5,6\n"
      "1,9,base,elbow,7,");
  EXPECT_EQ(table.columns[2], (std::vector<double>{1, 4}));
  EXPECT_EQ(table.line_of_row, (std::vector<std::int64_t>{2, 7}));
  ASSERT_GE(table.remarks.size(), 3u);
  EXPECT_EQ(table.remarks[0], "The last line, 8, was cut short and is left out.");
  EXPECT_TRUE(table.remarks[1].starts_with("Messages of other joints were left out: 1, the first in line 6."));
  EXPECT_EQ(table.remarks[2], "Lines that are no message were left out: 4, the first is line 1.");
}

TEST(RosEcho, DamagedRowsNameTheirLine) {
  for (std::string const row : {"1,5,base,elbow,4,5", "1,5,base,elbow,4,5,6,7", "1,1000000000,base,elbow,4,5,6",
                                "1,-5,base,elbow,4,5,6", "1,5,base,elbow,4,x,6", "x"}) {
    auto const problem = problem_of([&] { read("1,0,base,elbow,1,2,3\n" + row + "\n1,7,base,elbow,1,2,3\n"); });
    EXPECT_EQ(problem.code, ExitCode::bad_data);
    EXPECT_EQ(problem.what, "line 2 is no message like those before it") << row;
    EXPECT_EQ(problem.place.line, 2);
  }
}

TEST(RosEcho, TablesWithNamesBelongToOthers) {
  EXPECT_EQ(reader_of("1,0,base,elbow,1,2,3\n"), "ros_echo");
  EXPECT_EQ(reader_of("1,0,base," + std::string(5000, '1')), "ros_echo") << "a row longer than what is looked at";
  for (std::string const text :
       {"t_s,q_rad,tau_Nm\n1,2,3\n", "0,0,1.5,2\n", "0.5,0,base,2\n", "1;0;base;2\n", "# 1,0,base,2\n", "", "\n"})
    EXPECT_EQ(reader_of(text), "csv") << text;
}

}  // namespace ros_echo_test
}  // namespace torquescope
