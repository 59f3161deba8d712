#include "engine/data/column_guess.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace torquescope {
namespace column_guess_test {

using Columns = std::vector<std::pair<std::string, std::vector<double>>>;

RawTable table_of(Columns const& columns) {
  RawTable table;
  table.path = "arm.csv";
  for (auto const& [name, values] : columns) {
    table.names.push_back(name);
    table.columns.push_back(values);
  }
  return table;
}

std::vector<double> wave(double amplitude, double phase = 0.0) {
  std::vector<double> values;
  for (int k = 0; k < 200; ++k) values.push_back(amplitude * std::sin(0.1 * k + phase));
  return values;
}

std::vector<double> rounded(std::vector<double> values) {
  for (double& value : values) value = std::round(value);
  return values;
}

TEST(ColumnGuess, TakesTheChannelsOfOneJoint) {
  auto const guess = guess_columns(
      table_of({{"t_s", wave(1)}, {"r_rad", wave(1)}, {"q_rad", wave(1)}, {"dq", wave(2)}, {"tau_Nm", wave(3)}}));
  EXPECT_EQ(guess.position.column, "q_rad");
  EXPECT_EQ(guess.torque.column, "tau_Nm");
  EXPECT_EQ(guess.reference.column, "r_rad");
  EXPECT_EQ(guess.velocity.column, "dq");
  EXPECT_EQ(guess.joints, 1u);
}

TEST(ColumnGuess, TellsJointsApartByNumberOrName) {
  Columns const numbered{{"q1_rad", wave(1)}, {"q2_rad", wave(2)}, {"qd1_radps", wave(1)}, {"qd2_radps", wave(1)},
                         {"i1_A", wave(1)},   {"i2_A", wave(1)},   {"ides1_A", wave(1)},   {"ides2_A", wave(1)}};
  auto const second = guess_columns(table_of(numbered), 2);
  EXPECT_EQ(second.joints, 2u);
  EXPECT_EQ(second.position.column, "q2_rad");
  EXPECT_EQ(second.torque.column, "i2_A");
  EXPECT_EQ(second.velocity.column, "qd2_radps");
  EXPECT_EQ(second.torque.others, std::vector<std::string>{"ides2_A"});
  EXPECT_EQ(guess_columns(table_of(numbered)).position.column, "q1_rad");

  auto const named = guess_columns(table_of({{"/joint_states/shoulder/position", wave(1)},
                                             {"/joint_states/shoulder/effort", wave(1)},
                                             {"/joint_states/elbow/position", wave(1)},
                                             {"/joint_states/elbow/effort", wave(2)}}),
                                   2);
  EXPECT_EQ(named.joints, 2u);
  EXPECT_EQ(named.position.column, "/joint_states/elbow/position");
  EXPECT_EQ(named.torque.column, "/joint_states/elbow/effort");
}

// a topic of commands is no measurement, whichever stands first
TEST(ColumnGuess, ACommandIsNotThePosition) {
  auto const guess = guess_columns(table_of({{"joint_commands/elbow/position", wave(1)},
                                             {"joint_states/elbow/position", wave(1)},
                                             {"joint_states/elbow/effort", wave(1)}}));
  EXPECT_EQ(guess.position.column, "joint_states/elbow/position");
  EXPECT_EQ(guess.reference.column, "joint_commands/elbow/position");
  auto const echoed = guess_columns(table_of({{"elbow/reference.position", wave(1)},
                                              {"elbow/feedback.position", wave(1)},
                                              {"elbow/feedback.effort", wave(1)}}));
  EXPECT_EQ(echoed.position.column, "elbow/feedback.position");
  EXPECT_EQ(echoed.reference.column, "elbow/reference.position");
}

TEST(ColumnGuess, NamesThePositionOfEveryJoint) {
  auto const guess = guess_columns(table_of({{"wrist/position", wave(1)},
                                             {"elbow/position", wave(1)},
                                             {"wrist/effort", wave(1)},
                                             {"elbow/effort", wave(1)}}));
  EXPECT_EQ(guess.positions, (std::vector<std::string>{"wrist/position", "elbow/position"}));
}

TEST(ColumnGuess, OfAJointThatIsNotThereIsEmpty) {
  auto const guess = guess_columns(table_of({{"q_rad", wave(1)}, {"tau_Nm", wave(1)}}), 3);
  EXPECT_EQ(guess.joint, 3u);
  EXPECT_EQ(guess.joints, 1u);
  EXPECT_TRUE(guess.position.column.empty());
}

TEST(ColumnGuess, TakesTheFirstJointThatMovesUnlessOneIsNamed) {
  auto const still = std::vector<double>(200, 0.0);
  for (auto const& first : {wave(1e-4), still}) {
    auto const guess =
        guess_columns(table_of({{"q1_rad", first}, {"q2_rad", wave(1)}, {"tau1_Nm", wave(1)}, {"tau2_Nm", wave(1)}}));
    EXPECT_EQ(guess.joint, 2u);
    EXPECT_EQ(guess.position.column, "q2_rad");
    EXPECT_TRUE(guess.passes_over_others);
  }
  auto const table = table_of({{"q1_rad", wave(1)}, {"q2_rad", wave(1)}, {"tau1_Nm", still}, {"tau2_Nm", wave(1)}});
  EXPECT_EQ(guess_columns(table).torque.column, "tau2_Nm") << "a torque that never changes cannot be fitted";
  EXPECT_EQ(guess_columns(table, 1).position.column, "q1_rad") << "a person's word is kept";
  EXPECT_FALSE(guess_columns(table, 1).passes_over_others);
}

// 9999 in a few rows is no motion, and makes none of the others stand still
TEST(ColumnGuess, ASentinelIsNoMotion) {
  auto still = std::vector<double>(200, 0.5);
  still[70] = still[120] = 9999.0;
  auto const guess =
      guess_columns(table_of({{"q1_rad", still}, {"q2_rad", wave(1)}, {"tau1_Nm", wave(1)}, {"tau2_Nm", wave(1)}}));
  EXPECT_EQ(guess.joint, 2u);
  EXPECT_EQ(guess.moving_joints, 1u);
}

TEST(ColumnGuess, SaysWhichJointMoves) {
  auto const guess = guess_columns(
      table_of({{"q1_rad", wave(1e-4)}, {"q2_rad", wave(1)}, {"tau1_Nm", wave(1)}, {"tau2_Nm", wave(1)}}), 1);
  EXPECT_EQ(guess.joint, 1u);
  EXPECT_EQ(guess.joint_that_moves, 2u);
  EXPECT_EQ(guess.moving_joints, 1u);
}

TEST(ColumnGuess, PutsColumnsTogetherThatShareNoWord) {
  auto const guess =
      guess_columns(table_of({{"motor_position", wave(1)}, {"shaft_torque", wave(1)}, {"goal", wave(1)}}));
  EXPECT_EQ(guess.position.column, "motor_position");
  EXPECT_EQ(guess.torque.column, "shaft_torque");
  EXPECT_EQ(guess.reference.column, "goal");
}

TEST(ColumnGuess, WholeNumbersWithoutAUnitAreCounts) {
  auto const guess = guess_columns(table_of({{"present_position", rounded(wave(2000))},
                                             {"present_current", rounded(wave(300))},
                                             {"tau_Nm", rounded(wave(60))}}));
  EXPECT_TRUE(guess.position.counts);
  EXPECT_FALSE(guess.torque.counts) << "a name that says N m is believed";
  EXPECT_FALSE(guess_columns(table_of({{"q", wave(2000)}, {"tau", wave(1)}})).position.counts);
}

TEST(ColumnGuess, BelievesARowOfUnits) {
  auto table = table_of({{"q", wave(60)}, {"M", wave(1)}, {"torque", wave(1)}});
  table.units = {"deg", "", "mNm"};
  auto const guess = guess_columns(table);
  ASSERT_TRUE(guess.position.name.unit && guess.torque.name.unit);
  EXPECT_EQ(guess.position.name.unit->word, "deg");
  EXPECT_EQ(guess.torque.name.unit->si, 1e-3);
}

TEST(ColumnGuess, AColumnThatNeverChangesServesLast) {
  auto const guess =
      guess_columns(table_of({{"q_rad", wave(1)}, {"tau_Nm", std::vector<double>(200, 0.0)}, {"i_A", wave(1)}}));
  EXPECT_EQ(guess.torque.column, "i_A");
  EXPECT_EQ(guess.torque.others, std::vector<std::string>{"tau_Nm"});
}

std::vector<double> switched() {
  std::vector<double> values(200, 1.0);
  std::fill(values.begin() + 150, values.end(), 0.0);
  return values;
}

TEST(ColumnGuess, ASwitchIsNoTorque) {
  for (char const* name : {"torque_enabled", "enabled", "drive_on", "motor_on", "TorqueEnable", "torque_enable"}) {
    auto const guess =
        guess_columns(table_of({{"t_s", wave(1)}, {"goal_rad", wave(1)}, {"q_rad", wave(1)}, {name, switched()}}));
    EXPECT_EQ(guess.enabled.column, name);
    EXPECT_EQ(guess.torque.column, "") << name;
    EXPECT_EQ(guess.reference.column, "goal_rad");
  }
  auto const beside = guess_columns(table_of({{"q_rad", wave(1)}, {"torque_enabled", switched()}, {"tau", wave(1)}}));
  EXPECT_EQ(beside.torque.column, "tau");
  EXPECT_EQ(beside.enabled.column, "torque_enabled");
  // other numbers, or a name that says nothing of the kind
  EXPECT_EQ(guess_columns(table_of({{"q_rad", wave(1)}, {"torque_enabled", wave(1)}})).enabled.column, "");
  EXPECT_EQ(guess_columns(table_of({{"q_rad", wave(1)}, {"torque", switched()}})).torque.column, "torque");
}

TEST(ColumnGuess, AConstantTorqueGivesWayToOneOfAnotherName) {
  auto const guess = guess_columns(
      table_of({{"q_rad", wave(1)}, {"tau_Nm", std::vector<double>(200, 0.0)}, {"motor_current_A", wave(1)}}));
  EXPECT_EQ(guess.torque.column, "motor_current_A");
}

TEST(ColumnGuess, JointsWithoutTorqueHaveAReference) {
  Columns const two{{"q1_rad", wave(1)},    {"q2_rad", wave(2)},      {"goal1_rad", wave(1)},
                    {"goal2_rad", wave(2)}, {"enabled1", switched()}, {"enabled2", switched()}};
  auto const second = guess_columns(table_of(two), 2);
  EXPECT_EQ(second.joints, 2u);
  EXPECT_EQ(second.position.column, "q2_rad");
  EXPECT_EQ(second.reference.column, "goal2_rad");
  EXPECT_EQ(second.enabled.column, "enabled2");
}

TEST(ColumnGuess, TakesNoTorqueWhereNoneIsWanted) {
  auto const guess =
      guess_columns(table_of({{"q_rad", wave(1)}, {"goal_rad", wave(1)}, {"V_V", wave(1)}}), 0, TorqueColumn::optional);
  EXPECT_EQ(guess.torque.column, "");
  EXPECT_EQ(guess.reference.column, "goal_rad");
}

Columns six_joints(int first_position, int first_torque, std::string const& torque = "tau") {
  Columns columns{{"t_s", wave(1)}};
  for (int k = 0; k < 6; ++k) columns.push_back({"q" + std::to_string(first_position + k), wave(1, k)});
  for (int k = 0; k < 6; ++k) columns.push_back({torque + std::to_string(first_torque + k), wave(2, k)});
  return columns;
}

TEST(ColumnGuess, PairsJointsThatAreCountedFromZeroAndFromOne) {
  for (auto const& [from, other] : {std::pair{0, 1}, {1, 0}}) {
    auto const guess = guess_columns(table_of(six_joints(from, other)), 6);
    EXPECT_EQ(guess.joints, 6u);
    EXPECT_EQ(guess.position.column, "q" + std::to_string(from + 5));
    EXPECT_EQ(guess.torque.column, "tau" + std::to_string(other + 5));
    ASSERT_EQ(guess.shifts.size(), 1u);
    EXPECT_EQ(guess.shifts[0].position, "q" + std::to_string(from));
    EXPECT_EQ(guess.shifts[0].other, "tau" + std::to_string(other));
  }
  // counted alike, and a second family that is not
  EXPECT_TRUE(guess_columns(table_of(six_joints(1, 1))).shifts.empty());
  auto both = six_joints(0, 0);
  for (int k = 1; k <= 6; ++k) both.push_back({"goal_pos_" + std::to_string(k), wave(1, k)});
  auto const guess = guess_columns(table_of(both), 2);
  EXPECT_EQ(guess.torque.column, "tau1");
  EXPECT_EQ(guess.reference.column, "goal_pos_2");
  // five torques beside six positions: which one has none cannot be told by counting
  auto five = six_joints(0, 1);
  five.pop_back();
  EXPECT_EQ(guess_columns(table_of(five)).joints, 5u);
}

TEST(ColumnGuess, CommandsAreNoFurtherJoints) {
  for (std::string const word :
       {"cmd", "des", "desired", "goal", "target", "ref", "reference", "setpoint", "sp", "command", "commanded", "d"})
    for (bool const in_front : {false, true}) {
      if (word == "d" && in_front) continue;
      Columns columns{{"t", wave(1)}};
      for (std::string const joint : {"1", "2"})
        for (std::string const quantity : {"q", "tau"}) {
          columns.push_back({quantity + "_" + joint, wave(1)});
          columns.push_back({in_front ? word + "_" + quantity + "_" + joint : quantity + "_" + word + joint, wave(2)});
        }
      auto const guess = guess_columns(table_of(columns), 2);
      EXPECT_EQ(guess.joints, 2u) << word;
      EXPECT_EQ(guess.position.column, "q_2") << word;
      EXPECT_EQ(guess.torque.column, "tau_2") << word;
      EXPECT_EQ(guess.reference.column, in_front ? word + "_q_2" : "q_" + word + "2");
    }
}

TEST(ColumnGuess, PassesOverColumnsAndJointsThatNeverChange) {
  std::vector<double> const still(200, 0.0);
  auto const guess = guess_columns(table_of({{"q1", still},
                                             {"q2", wave(1)},
                                             {"effort1", still},
                                             {"effort2", still},
                                             {"motor_current_1", wave(1)},
                                             {"motor_current_2", wave(2)}}));
  EXPECT_EQ(guess.joints, 2u);
  EXPECT_EQ(guess.joint, 2u);
  EXPECT_EQ(guess.position.column, "q2");
  EXPECT_EQ(guess.torque.column, "motor_current_2");
}

TEST(ColumnGuess, AMeasuredTorqueOfAnotherNameGoesBeforeACommandedOne) {
  auto const guess = guess_columns(table_of({{"q1", wave(1)},
                                             {"q2", wave(1)},
                                             {"tau_des_1", wave(1)},
                                             {"tau_des_2", wave(1)},
                                             {"joint_1_torque", wave(1)},
                                             {"joint_2_torque", wave(1)}}),
                                   2);
  EXPECT_EQ(guess.joints, 2u);
  EXPECT_EQ(guess.torque.column, "joint_2_torque");
}

TEST(ColumnGuess, PrefersNewtonMetresToAnUnknownUnit) {
  auto const guess = guess_columns(table_of({{"t", wave(1)}, {"i", wave(2)}, {"torAct", wave(3)}, {"q", wave(1)}}));
  EXPECT_EQ(guess.torque.column, "torAct");
}

}  // namespace column_guess_test
}  // namespace torquescope
