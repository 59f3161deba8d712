#include "engine/app/terminal/table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {
namespace table_test {

using Align = TextTable::Align;

TEST(TextTable, AlignsItsColumns) {
  TextTable table({Align::left, Align::right, Align::left}, "  ");
  table.row({"a", "1", "x"});
  table.row({"long", "-20", "y"});
  EXPECT_EQ(table.text(80),
            "  a       1  x\n"
            "  long  -20  y\n");
}

TEST(TextTable, BreaksItsLastColumnAndNothingElse) {
  TextTable table({Align::left, Align::left}, "  ");
  table.row({"key", "one two three four five six seven eight nine ten"});
  std::istringstream lines(table.text(30));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_LE(columns_of(line), 30);
    EXPECT_EQ(line.substr(0, 7), count ? "       " : "  key  ");
  }
  EXPECT_GT(count, 1);
}

TEST(TextTable, PutsColumnsWithoutRoomBelowTheOthersRowByRow) {
  TextTable table({Align::left, Align::right, Align::right, Align::left});
  table.row({"effect", "before", "after", "reason"});
  table.row({"stribeck", "12.25", "6.125", ""});
  EXPECT_EQ(table.text(80),
            "effect    before  after  reason\n"
            "stribeck   12.25  6.125\n");
  EXPECT_EQ(table.text(20),
            "effect    before\n"
            "    after  reason\n"
            "stribeck   12.25\n"
            "    6.125\n");
}

TEST(TextTable, LeavesNoSpacesAtTheEndOfALine) {
  TextTable table({Align::left, Align::left, Align::right});
  table.row({"a"});
  EXPECT_EQ(table.text(80), "a\n");
}

TEST(Numbers, HaveFourDigitsAndNaNIsNothing) {
  EXPECT_EQ(short_number(0.0164), "0.0164");
  EXPECT_EQ(short_number(-0.25823), "-0.2582");
  EXPECT_EQ(short_number(95.108932), "95.11");
  EXPECT_EQ(short_number(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(rough_number(8.3e-12), "8e-12");
}

}  // namespace table_test
}  // namespace torquescope
