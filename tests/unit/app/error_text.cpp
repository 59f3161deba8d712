// Golden texts: the examples of the interface specification, letter by letter.

#include "engine/app/terminal/error_text.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {
namespace error_text_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;

Problem unknown_key_problem() {
  Problem problem;
  problem.what = "unknown key \"cutof_hz\"";
  problem.place = {"jobs/lab.toml", 14, 1, 8, "cutof_hz = 25"};
  problem.key = "filter.cutof_hz";
  problem.caret_note = "did you mean \"cutoff_hz\"?      (torquescope describe filter)";
  return problem;
}

TEST(ErrorText, UnknownKey) {
  EXPECT_EQ(error_text({unknown_key_problem()}, Ink()),
            "error: unknown key \"cutof_hz\"                                          [78]\n"
            "  --> jobs/lab.toml:14:1\n"
            "14 | cutof_hz = 25\n"
            "   | ^^^^^^^^ did you mean \"cutoff_hz\"?      (torquescope describe filter)\n");
}

TEST(ErrorText, MissingColumnWithNoteAndHelp) {
  Problem problem;
  problem.what = "no column \"tau\" in arm.csv";
  problem.place = {"jobs/lab.toml", 8, 45, 5, ""};
  problem.notes = {"the file has: t_s, q_rad, i_A"};
  problem.help = "torque = \"i_A\" with torque_per_unit = <N m per A>";
  EXPECT_EQ(error_text({problem}, Ink()),
            "error: no column \"tau\" in arm.csv                                      [78]\n"
            "  --> jobs/lab.toml:8:45\n"
            "  the file has: t_s, q_rad, i_A\n"
            "  help: torque = \"i_A\" with torque_per_unit = <N m per A>\n");
}

TEST(ErrorText, DataErrorHasItsLineOnly) {
  Problem problem;
  problem.code = ExitCode::bad_data;
  problem.what = "17 values of \"q_rad\" are not numbers, first in line 20412";
  problem.place = {"arm.csv", 20412, 0, 0, ""};
  EXPECT_EQ(error_text({problem}, Ink()),
            "error: 17 values of \"q_rad\" are not numbers, first in line 20412       [65]\n"
            "  --> arm.csv:20412\n");
}

TEST(ErrorText, AStoppedRunIsNoError) {
  Problem problem;
  problem.code = ExitCode::stopped;
  problem.what = "stopped by time budget (3600 s): 20 of 30 runs are safe";
  problem.help = "run the same command again to continue";
  EXPECT_EQ(error_text({problem}, Ink()),
            "stopped by time budget (3600 s): 20 of 30 runs are safe                [75]\n"
            "  help: run the same command again to continue\n");
}

TEST(ErrorText, AreAllThereUpToTwentyThenTheirCount) {
  std::string const three = error_text({3, unknown_key_problem()}, Ink());
  EXPECT_THAT(three, EndsWith("\n3 problems\n"));
  std::string const many = error_text({27, unknown_key_problem()}, Ink());
  EXPECT_THAT(many, EndsWith("\n27 problems, the first 20 are shown\n"));
  std::size_t shown = 0;
  for (std::size_t at = many.find("error:"); at != std::string::npos; at = many.find("error:", at + 1)) ++shown;
  EXPECT_EQ(shown, 20u);
}

TEST(ErrorText, HasNoLineOver80Columns) {
  Problem problem = unknown_key_problem();
  for (int i = 0; i < 40; ++i) {
    problem.what += " more words";
    problem.caret_note += " more words";
    problem.help += " more words";
  }
  problem.notes = {problem.help};
  for (int column : {1, 40, 150, 300}) {
    problem.place = {"jobs/lab.toml", 14, column, 60, std::string(300, 'x')};
    std::istringstream lines(error_text({problem}, Ink()));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(columns_of(line), 80) << line;
  }
}

TEST(ErrorText, PointsAtTheRightLetterOfALongLine) {
  Problem problem = unknown_key_problem();
  problem.caret_note.clear();
  problem.place = {"lab.toml", 3, 201, 3, std::string(200, 'x') + "BAD" + std::string(200, 'x')};
  std::istringstream lines(error_text({problem}, Ink()));
  std::string headline, place, source, carets;
  std::getline(lines, headline);
  std::getline(lines, place);
  std::getline(lines, source);
  std::getline(lines, carets);
  EXPECT_EQ(source.find("BAD"), carets.find("^^^"));
}

TEST(ErrorText, PointsBehindLettersOfTwoBytes) {
  Problem problem = unknown_key_problem();
  problem.caret_note.clear();
  problem.place = {"lab.toml", 3, 9, 2, "a = \"ä\" xy"};
  EXPECT_THAT(error_text({problem}, Ink()), HasSubstr("3 | a = \"ä\" xy\n  |         ^^\n"));
}

TEST(ErrorText, QuotesNoControlCharacterOfTheFile) {
  Problem problem = unknown_key_problem();
  problem.what = "bad \x1b[2J";
  problem.place.line_text = "\x1b]0;title\x07 cutof_hz";
  problem.notes = {"\x1b[31m"};
  std::string const text = error_text({problem}, Ink());
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find('\x07'), std::string::npos);
}

TEST(ErrorText, SaysTheSameInColour) {
  std::string const coloured = error_text({unknown_key_problem()}, Ink(true));
  std::string plain;
  bool in_escape = false;
  for (char const letter : coloured) {
    if (letter == '\x1b') in_escape = true;
    if (!in_escape) plain += letter;
    if (letter == 'm') in_escape = false;
  }
  EXPECT_NE(coloured, plain);
  EXPECT_EQ(plain, error_text({unknown_key_problem()}, Ink()));
}

TEST(ErrorJson, HasTheStableKeysAndNullsForWhatIsUnknown) {
  auto const document = nlohmann::json::parse(error_json({unknown_key_problem(), Problem{ExitCode::bad_data, "bad"}}));
  EXPECT_EQ(document["schema"], 1);
  EXPECT_EQ(document["error"]["code"], 78);
  EXPECT_EQ(document["error"]["file"], "jobs/lab.toml");
  EXPECT_EQ(document["error"]["line"], 14);
  EXPECT_EQ(document["error"]["key"], "filter.cutof_hz");
  EXPECT_EQ(document["error"]["problem"], "unknown key \"cutof_hz\"");
  EXPECT_TRUE(document["error"]["help"].is_null());
  ASSERT_EQ(document["errors"].size(), 2u);
  EXPECT_TRUE(document["errors"][1]["file"].is_null());
}

TEST(ErrorJson, SurvivesBytesThatAreNoText) {
  EXPECT_TRUE(nlohmann::json::accept(error_json({Problem{ExitCode::bad_data, "bad \xff byte"}})));
}

}  // namespace error_text_test
}  // namespace torquescope
