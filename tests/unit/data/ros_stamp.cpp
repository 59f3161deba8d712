// Seconds and nanoseconds of ROS as one column; space that was never written at the end of a table.

#include "engine/data/ros_stamp.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "engine/data/unwritten_tail.hpp"

namespace torquescope {
namespace ros_stamp_test {

RawTable table_of(std::vector<std::string> names, std::vector<std::vector<double>> columns) {
  RawTable table;
  table.names = std::move(names);
  table.columns = std::move(columns);
  return table;
}

TEST(RosStamp, DifferencesAreExactToANanosecond) {
  auto table = table_of({"header.stamp.sec", "header.stamp.nanosec", "q"},
                        {{1768472944, 1768472944, 1768472945}, {5, 999999999, 7}, {0, 1, 2}});
  add_ros_stamps(table);
  ASSERT_EQ(table.names.size(), 4u);
  EXPECT_EQ(table.names[3], "header.stamp");
  EXPECT_EQ(table.columns[3], (std::vector<double>{5e-9, 999999999e-9, 1.0 + 7e-9}));
  ASSERT_EQ(table.remarks.size(), 1u);
  EXPECT_EQ(table.remarks[0],
            "\"header.stamp\" was added: \"header.stamp.sec\" + \"header.stamp.nanosec\" in seconds, counted from the "
            "first \"header.stamp.sec\".");
}

TEST(RosStamp, NamesOfBothRosAreKnown) {
  for (auto const& [sec, nanosec, stamp] : std::vector<std::array<std::string, 3>>{
           {"sec", "nanosec", "stamp"},
           {"secs", "nsecs", "stamp"},
           {"stamp.sec", "stamp.nanosec", "stamp"},
           {"field.header.stamp.secs", "field.header.stamp.nsecs", "field.header.stamp"},
           {"/joint_states/header/stamp/sec", "/joint_states/header/stamp/nanosec", "/joint_states/header/stamp"},
           {"header_sec", "header_nanosec", "header_stamp"}}) {
    auto table = table_of({"q", nanosec, sec}, {{0, 1}, {0, 1000000}, {10, 10}});
    add_ros_stamps(table);
    ASSERT_EQ(table.names.size(), 4u) << sec;
    EXPECT_EQ(table.names[3], stamp);
    EXPECT_EQ(table.columns[3], (std::vector<double>{0, 0.001}));
    EXPECT_EQ(stamp_with_fractions(table, sec), stamp);
    EXPECT_EQ(stamp_with_fractions(table, "q"), "");
  }
}

TEST(RosStamp, OtherColumnsAreLeftAlone) {
  auto fractions = table_of({"sec", "nanosec"}, {{0.5, 1.5}, {0, 1}});
  auto other_prefix = table_of({"a.sec", "b.nanosec"}, {{0, 1}, {0, 1}});
  auto beyond_a_second = table_of({"sec", "nanosec"}, {{0, 1}, {0, 2e9}});
  auto taken = table_of({"stamp.sec", "stamp.nanosec", "stamp"}, {{0, 1}, {0, 1}, {0, 1}});
  for (auto* table : {&fractions, &other_prefix, &beyond_a_second, &taken}) {
    std::size_t const n = table->names.size();
    add_ros_stamps(*table);
    EXPECT_EQ(table->names.size(), n);
    EXPECT_TRUE(table->remarks.empty());
    EXPECT_EQ(stamp_with_fractions(*table, table->names.front()), "");
  }
}

TEST(UnwrittenTail, ZerosBehindTheClockAreLeftOut) {
  auto table = table_of({"t", "q", "row"}, {{0, 0.1, 0.2, 0, 0, 0}, {1, 0, 3, 0, 0, 0}, {0, 1, 2, 3, 4, 5}});
  table.line_of_row = {2, 3, 4, 5, 6, 7};
  drop_unwritten_tail(table);
  EXPECT_EQ(table.columns[0], (std::vector<double>{0, 0.1, 0.2}));
  EXPECT_EQ(table.columns[2].size(), 3u);
  EXPECT_EQ(table.line_of_row.size(), 3u);
  EXPECT_EQ(table.remarks, (std::vector<std::string>{"The last 3 of 6 rows hold nothing but zeros, as space that was "
                                                     "never written: they are left out."}));
}

TEST(UnwrittenTail, RowsWithoutNumbersAreLeftOut) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  auto table = table_of({"t", "q"}, {{0, 0.1, nan, nan}, {1, nan, nan, nan}});
  drop_unwritten_tail(table);
  EXPECT_EQ(table.columns[0], (std::vector<double>{0, 0.1}));
}

TEST(UnwrittenTail, StandstillUnderARunningClockStays) {
  auto running = table_of({"t", "q"}, {{0, 0.1, 0.2, 0.3}, {1, 2, 0, 0}});
  auto no_clock = table_of({"q", "tau"}, {{1, -2, 0, 0}, {3, 1, 0, 0}});
  auto one_signal_goes_on = table_of({"t", "q"}, {{0, 0.1, 0, 0}, {1, 2, 0, 1}});
  for (auto* table : {&running, &no_clock, &one_signal_goes_on}) {
    drop_unwritten_tail(*table);
    EXPECT_EQ(table->columns[0].size(), 4u);
    EXPECT_TRUE(table->remarks.empty());
  }
}

}  // namespace ros_stamp_test
}  // namespace torquescope
