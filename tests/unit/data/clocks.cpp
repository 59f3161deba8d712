// Channels with clocks of their own: found in a table, put into one, refused where they cannot be.

#include <gmock/gmock.h>

#include <cmath>

#include "engine/data/clock_blocks.hpp"
#include "engine/data/own_clocks.hpp"
#include "engine/data/repeated_names.hpp"
#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace clocks_test {

using data_test::problem_of;
using data_test::recording_section;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<double> even(std::size_t n, double first, double step) {
  std::vector<double> values;
  for (std::size_t k = 0; k < n; ++k) values.push_back(first + step * static_cast<double>(k));
  return values;
}

// position at 0, 1, 2, ... s, torque at 0.5, 1, 1.5, ... s over half of the rows
RawTable blocks() {
  RawTable table{"a.csv", "x", {"Time#1", "Position", "Time#2", "Torque"}, {}};
  table.columns = {even(40, 0, 1), even(40, 0, 10), even(40, 0.5, 0.5), even(40, 100, 1)};
  for (std::size_t k = 30; k < 40; ++k) table.columns[2][k] = table.columns[3][k] = none;
  for (std::int64_t k = 0; k < 40; ++k) table.line_of_row.push_back(k + 2);
  return table;
}

RecordingOptions options() {
  RecordingOptions options;
  options.columns = {{"time", "Time#1"}, {"position", "Position"}, {"torque", "Torque"}};
  options.clocks = {{"torque", "Time#2"}};
  return options;
}

RawTable merged(RawTable const& table, RecordingOptions const& by) {
  return on_one_clock(table, by, recording_section(), TorqueColumn::required);
}

TEST(OwnClocks, RowsOfAllClocksStandInTheOrderOfTimeAndShareEqualStamps) {
  auto const table = merged(blocks(), options());
  ASSERT_THAT(table.names, ElementsAre("Time#1", "Position", "Torque"));
  ASSERT_EQ(table.columns[0].size(), 40u + 15u);  // every second stamp of the torque is one of the position
  for (std::size_t k = 1; k < table.columns[0].size(); ++k) EXPECT_LT(table.columns[0][k - 1], table.columns[0][k]);
  for (std::size_t k = 0; k < table.columns[0].size(); ++k) {
    double const time = table.columns[0][k];
    if (time == std::floor(time))
      EXPECT_EQ(table.columns[1][k], 10 * time);
    else
      EXPECT_TRUE(std::isnan(table.columns[1][k]));
    if (time >= 0.5 && time <= 15.0)
      EXPECT_EQ(table.columns[2][k], 100 + (time - 0.5) / 0.5);
    else
      EXPECT_TRUE(std::isnan(table.columns[2][k]));
  }
  EXPECT_TRUE(table.has_merged_clocks);
  EXPECT_EQ(table.line_of_row.size(), table.columns[0].size());
  EXPECT_THAT(table.remarks.back(), HasSubstr("\"Time#2\""));
}

TEST(OwnClocks, WhatCannotBeMergedIsRefusedWithItsPlace) {
  auto const refused = [](RawTable const& table, RecordingOptions const& by) {
    return problem_of([&] { merged(table, by); });
  };
  auto no_such = options();
  no_such.clocks["torque"] = "Time#3";
  EXPECT_THAT(refused(blocks(), no_such).what, HasSubstr("no column \"Time#3\""));
  auto of_nothing = options();
  of_nothing.clocks["reference"] = "Time#2";
  EXPECT_THAT(refused(blocks(), of_nothing).what, HasSubstr("of no channel"));
  auto of_position = options();
  of_position.clocks["position"] = "Time#2";
  EXPECT_THAT(refused(blocks(), of_position).what, HasSubstr("clock of the recording"));
  auto backwards = blocks();
  backwards.columns[2][5] = 0;
  EXPECT_THAT(refused(backwards, options()).what, HasSubstr("runs backwards in line 7"));
  auto without_stamp = blocks();
  without_stamp.columns[2][5] = none;
  EXPECT_THAT(refused(without_stamp, options()).what, HasSubstr("no stamp in line 7"));
}

TEST(ClockBlocks, EachColumnHasTheClockBeforeIt) {
  auto const clocks = clocks_of_columns(blocks());
  ASSERT_EQ(clocks.size(), 2u);
  EXPECT_EQ(clocks.at("Position"), "Time#1");
  EXPECT_EQ(clocks.at("Torque"), "Time#2");
  EXPECT_FALSE(is_same_clock(blocks(), "Time#1", "Time#2"));
}

TEST(ClockBlocks, OneClockInTwoUnitsAndLaterTimesAreNoBlocks) {
  auto two_units = blocks();
  two_units.names = {"t_s", "t_ms", "Position", "Torque"};
  two_units.columns[1] = even(40, 0, 1000);
  EXPECT_TRUE(clocks_of_columns(two_units).empty());
  auto another_day = blocks();
  another_day.columns[2] = even(40, 1e6, 0.5);
  EXPECT_TRUE(clocks_of_columns(another_day).empty());
  auto one_clock = blocks();
  one_clock.names = {"Time", "Position", "Temperature", "Torque"};
  EXPECT_TRUE(clocks_of_columns(one_clock).empty());
}

TEST(RepeatedNames, AreNumberedAndTakenApart) {
  EXPECT_THAT(with_numbers_of_repeats({"t", "q", "t", "tau"}), ElementsAre("t#1", "q", "t#2", "tau"));
  EXPECT_THAT(with_numbers_of_repeats({"t", "q", "t#1"}), ElementsAre("t", "q", "t#1"));
  EXPECT_EQ(without_repeat("Torque [Nm]#12"), "Torque [Nm]");
  EXPECT_EQ(number_of_repeat("Torque [Nm]#12"), "12");
  EXPECT_EQ(number_of_repeat("tau#a"), "");
  EXPECT_EQ(without_repeat("#1"), "#1");
}

}  // namespace clocks_test
}  // namespace torquescope
