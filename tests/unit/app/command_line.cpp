#include "engine/app/command_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {
namespace command_line_test {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> const commands{"init",   "check",    "run",    "diagnose", "show",
                                        "report", "simulate", "excite", "list",     "describe"};

Problem problem_of(std::vector<std::string> const& words) {
  ParsedCommandLine parsed;
  try {
    parse_command_line(words, parsed);
  } catch (Error const& error) {
    return error.problems().front();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

std::string text_of(std::vector<std::string> const& words) {
  ParsedCommandLine parsed;
  parse_command_line(words, parsed);
  return parsed.text.value_or("");
}

TEST(CommandLine, SuggestsTheCommandThatWasMeant) {
  Problem const problem = problem_of({"chekc", "lab.toml"});
  EXPECT_EQ(problem.code, ExitCode::usage);
  EXPECT_EQ(problem.what, "unknown command \"chekc\"; did you mean \"check\"?");
}

TEST(CommandLine, SuggestsTheOptionThatWasMeant) {
  EXPECT_EQ(problem_of({"run", "lab.toml", "--thread", "3"}).what,
            "run has no option \"--thread\"; did you mean \"--threads\"?");
}

TEST(CommandLine, RefusesWithCode64) {
  for (std::vector<std::string> const& words : {std::vector<std::string>{},
                                                {"run"},
                                                {"run", "a", "b"},
                                                {"run", "a", "--threads", "0"},
                                                {"run", "a", "--threads", "2x"},
                                                {"run", "a", "--color", "blue"},
                                                {"simulate", "a"},
                                                {"excite", "a"},
                                                {"run", "a", "--out"},
                                                {"run", "a", "-o"},
                                                {"run", "a", "-j", "0"},
                                                {"run", "a", "-x"},
                                                {"help", "rum"},
                                                {"help", "run", "show"},
                                                {"show", "a", "--progress", "bar"}}) {
    Problem const problem = problem_of(words);
    EXPECT_EQ(problem.code, ExitCode::usage) << problem.what;
    EXPECT_FALSE(problem.help.empty());
  }
}

TEST(CommandLine, LeavesTheWorkOfTheChosenCommand) {
  ParsedCommandLine parsed;
  parse_command_line({"run", "lab.toml", "--quiet", "--json", "-", "--color", "never", "--progress", "none"}, parsed);
  EXPECT_TRUE(parsed.chosen.work);
  EXPECT_FALSE(parsed.text);
  EXPECT_TRUE(parsed.chosen.session.quiet);
  EXPECT_EQ(parsed.chosen.session.json, "-");
  EXPECT_EQ(parsed.chosen.session.colour, ColourChoice::never);
  EXPECT_EQ(parsed.chosen.session.progress, ProgressChoice::none);
}

TEST(CommandLine, TakesTheLettersOfCommonOptions) {
  ParsedCommandLine parsed;
  parse_command_line({"run", "lab.toml", "-q", "-j4", "-o", "lab.h5"}, parsed);
  EXPECT_TRUE(parsed.chosen.work);
  EXPECT_TRUE(parsed.chosen.session.quiet);
  for (std::string const name : {"init", "check", "run", "diagnose", "show", "report", "compare", "export", "merge",
                                 "status", "submit", "simulate", "excite"}) {
    std::string const page = text_of({name, "--help"});
    EXPECT_THAT(page, HasSubstr("\n  -q, --quiet ")) << name;
    for (char const* alone : {"\n  --quiet ", "\n  --out ", "\n  --threads "})
      EXPECT_THAT(page, Not(HasSubstr(alone))) << name;
  }
}

TEST(CommandLine, AnErrorAlreadyObeysJsonAndColor) {
  SessionOptions const options = session_options_of({"run", "--json=-", "--nonsense", "--color", "never"});
  EXPECT_EQ(options.json, "-");
  EXPECT_EQ(options.colour, ColourChoice::never);
}

TEST(Help, NamesEveryCommandOnOneScreen) {
  std::string const help = text_of({"--help"});
  for (auto const& command : commands) EXPECT_THAT(help, HasSubstr("torquescope " + command));
  EXPECT_LE(std::count(help.begin(), help.end(), '\n'), 24);
}

TEST(Help, HasNoLineOver80Columns) {
  std::vector<std::string> pages{text_of({"--help"}), text_of({"--version"})};
  for (auto const& command : commands) pages.push_back(text_of({command, "--help"}));
  for (auto const& page : pages) {
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(columns_of(line), 80) << line;
  }
}

TEST(Help, OfEveryCommandHasThreeExamplesBeforeItsOptions) {
  for (auto const& command : commands) {
    std::string const page = text_of({command, "--help"});
    std::size_t const options = page.find("files and names\n");
    ASSERT_NE(options, std::string::npos) << page;
    std::istringstream lines(page.substr(0, options));
    int examples = 0;
    for (std::string line; std::getline(lines, line);)
      examples += line.rfind("  ", 0) == 0 && line.find("torquescope ") != line.npos;
    EXPECT_EQ(examples, 3) << page;
  }
}

TEST(Help, OfACommandIsItsPage) {
  for (auto const& command : commands) EXPECT_EQ(text_of({"help", command}), text_of({command, "--help"}));
  EXPECT_EQ(text_of({"help", "--help"}), text_of({"--help"}));
  EXPECT_EQ(text_of({"help"}), text_of({"--help"}));
  EXPECT_EQ(problem_of({"help", "diagnos"}).what, "unknown command \"diagnos\"; did you mean \"diagnose\"?");
}

TEST(Help, OfRunNamesItsOptions) {
  std::string const page = text_of({"run", "--help"});
  for (char const* option : {"-o, --out R.h5", "-j, --threads N", "--json", "--progress", "-q, --quiet", "--color"})
    EXPECT_THAT(page, HasSubstr(option));
}

}  // namespace command_line_test
}  // namespace torquescope
