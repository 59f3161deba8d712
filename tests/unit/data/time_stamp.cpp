// Dates and clock times as seconds.

#include "engine/data/time_stamp.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace time_stamp_test {

double date(char const* text) {
  double seconds = -1.0;
  EXPECT_EQ(read_stamp(text, seconds), StampKind::date) << text;
  return seconds;
}

double clock(char const* text) {
  double seconds = -1.0;
  EXPECT_EQ(read_stamp(text, seconds), StampKind::clock) << text;
  return seconds;
}

TEST(TimeStamp, DatesCountFrom1970InUtc) {
  EXPECT_EQ(date("1970-01-01T00:00:00Z"), 0.0);
  EXPECT_EQ(date("2024-05-01T12:00:00"), 1714564800.0);
  EXPECT_EQ(date("2024-05-01 12:00:00.5"), 1714564800.5);
  EXPECT_EQ(date("2024-05-01T14:00:00+02:00"), 1714564800.0);
  EXPECT_EQ(date("2024-05-01T14:00:00,25+0200"), 1714564800.25);
  EXPECT_EQ(date("2024-05-01 07:00:00 -05"), 1714564800.0);
  EXPECT_EQ(date("2024-05-01 12:00:00 UTC"), 1714564800.0);
  EXPECT_EQ(date("2024/05/01 12:00:00"), 1714564800.0);
  EXPECT_EQ(date("01.05.2024 12:00:00"), 1714564800.0);
  EXPECT_EQ(date("5/1/2024 12:00:00 PM"), 1714564800.0);
  EXPECT_EQ(date("13/5/2024 12:00:00"), 1714564800.0 + 12 * 86400.0);
  EXPECT_EQ(date("2024-03-01T00:00:00") - date("2024-02-28T00:00:00"), 2 * 86400.0);  // a leap year
}

TEST(TimeStamp, ClocksCountFromMidnight) {
  EXPECT_EQ(clock("12:34:56.75"), 45296.75);
  EXPECT_EQ(clock("12:34:56,75"), 45296.75);
  EXPECT_EQ(clock("1:02:03"), 3723.0);
  EXPECT_EQ(clock("01:02:03:250"), 3723.25);
  EXPECT_EQ(clock("12:00:01 AM"), 1.0);
  EXPECT_EQ(clock("1:00:00.5 pm"), 46800.5);
}

TEST(TimeStamp, OtherTextIsNone) {
  double ignored = 0.0;
  for (auto const* text :
       {"", "run", "12:34", "24:00:00", "12:60:00", "12:00:61", "12:00:00.", "13:00:00 PM", "2024-13-01T00:00:00",
        "2024-02-30T00:00:00", "2024-05-01", "2024-05-01T", "2024-05-01T12:00:00+25:00", "2024-05-01T12:00:00 x",
        "2024-05/01T12:00:00", "a:bb:cc", "1.5", "-1:00:00", "12:00:00.1234567890123"})
    EXPECT_EQ(read_stamp(text, ignored), StampKind::none) << text;
}

}  // namespace time_stamp_test
}  // namespace torquescope
