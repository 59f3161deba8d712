#include "engine/app/terminal/plain_text.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <string>
#include <utility>

#include "engine/app/terminal/colour.hpp"

namespace torquescope {
namespace plain_text_test {

TEST(Printable, LeavesLettersOfEveryLanguage) { EXPECT_EQ(printable("Größe 力 π"), "Größe 力 π"); }

TEST(Printable, NeverSteersTheTerminal) {
  EXPECT_EQ(printable("a\x1b[31mb\r\n"), "a?[31mb??");
  EXPECT_EQ(printable("a\tb"), "a b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "1m"),
            "?1m");  // the one-letter form of escape [
  EXPECT_EQ(printable("\x7f"), "?");
}

TEST(Printable, ReplacesBrokenUtf8) {
  EXPECT_EQ(printable("a\xff"
                      "b"),
            "a?b");
  EXPECT_EQ(printable("a\xe2\x82"), "a?");
  EXPECT_EQ(printable("\xc0\xaf"), "?");
}

TEST(ColumnsOf, CountsLettersNotBytesAndNoColours) {
  EXPECT_EQ(columns_of("Größe"), 5);
  EXPECT_EQ(columns_of(Ink(true).bold("Größe mm")), 8);
}

TEST(Wrap, BreaksAtSpacesAndKeepsEveryWord) {
  EXPECT_EQ(wrap("one two three", 7, 7), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrap("one two three", 3, 9), (std::vector<std::string>{"one", "two three"}));
}

TEST(Wrap, KeepsWideGapsInsideALine) {
  EXPECT_EQ(wrap("a      (b)", 20, 20), (std::vector<std::string>{"a      (b)"}));
  EXPECT_EQ(wrap("a      (b)", 5, 5), (std::vector<std::string>{"a", "(b)"}));
}

TEST(Wrap, DoesNotCutAPath) {
  EXPECT_EQ(wrap("in /a/very/long/path now", 8, 8), (std::vector<std::string>{"in", "/a/very/long/path", "now"}));
}

TEST(PageWidth, IsThatOfColumnsBetweenFortyAndEighty) {
  char const* const before = std::getenv("COLUMNS");
  std::string const kept = before ? before : "";
  for (auto const& [columns, width] : {std::pair("47", 47), {"12", 40}, {"200", 80}}) {
    ::setenv("COLUMNS", columns, 1);
    EXPECT_EQ(page_width(), width);
  }
  before ? ::setenv("COLUMNS", kept.c_str(), 1) : ::unsetenv("COLUMNS");
}

TEST(Hanging, IndentsBelowItsLead) {
  EXPECT_EQ(hanging("  help: ", "one two three", 16), "  help: one two\n        three\n");
}

TEST(Texts, OfCountsBytesAndSeconds) {
  EXPECT_EQ(count_text(0), "0");
  EXPECT_EQ(count_text(999), "999");
  EXPECT_EQ(count_text(183000), "183 000");
  EXPECT_EQ(count_text(-1234567), "-1 234 567");
  EXPECT_EQ(bytes_text(999), "999 B");
  EXPECT_EQ(bytes_text(3'100'000), "3.1 MB");
  EXPECT_EQ(bytes_text(999'960), "1.0 MB");
  EXPECT_EQ(bytes_text(212'000'000), "212 MB");
  EXPECT_EQ(seconds_text(0.0123), "0.012 s");
  EXPECT_EQ(seconds_text(4.21), "4.2 s");
  EXPECT_EQ(seconds_text(200.0), "3 min 20 s");
  EXPECT_EQ(seconds_text(7500.0), "2 h 5 min");
  EXPECT_EQ(seconds_text(std::numeric_limits<double>::quiet_NaN()), "? s");
}

}  // namespace plain_text_test
}  // namespace torquescope
