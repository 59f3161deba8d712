// What completions and man pages make of an invented command, whose texts hold every sign that a shell or roff obeys.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/app/commands/all_commands.hpp"
#include "engine/app/shell/completion.hpp"
#include "engine/app/shell/man_page.hpp"

namespace torquescope {
namespace shell_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

CommandPage invented() {
  return {.name = "turn",
          .title = "Turns a joint's file. Twice.",
          .examples = {"torquescope turn a.csv | head -3", ".hidden \\n"},
          .arguments = {{.name = "REC.csv", .takes = "REC.csv|FILE", .meaning = "files", .repeats = true}},
          .options = {{.names = {"-o", "--out"}, .takes = "R.h5", .meaning = "it's [here]: $HOME", .group = "results"},
                      {.names = {"--fast"}, .takes = "", .meaning = "a flag", .group = "machine"}}};
}

TEST(Offer, IsReadFromWhatAnOptionTakes) {
  EXPECT_THAT(offer_for("REC.csv|R.h5.parts").endings, ElementsAre(".csv", ".parts"));
  EXPECT_THAT(offer_for("auto|bar|never").words, ElementsAre("auto", "bar", "never"));
  EXPECT_TRUE(offer_for("fade|FILE").any_file);
  EXPECT_THAT(offer_for("fade|FILE").words, ElementsAre("fade"));
  for (char const* free : {"", "N", "S", "I/N", "H:M:S", "NAME", "OPTION"})
    EXPECT_TRUE(offer_for(free).is_nothing()) << free;
}

TEST(CommandPages, AreOfEveryCommandInItsOrder) {
  auto const pages = command_pages();
  std::vector<std::string> names;
  for (auto const& page : pages) names.push_back(page.name);
  EXPECT_EQ(names, command_names());
  for (auto const& page : pages) {
    EXPECT_FALSE(page.title.empty()) << page.name;
    EXPECT_FALSE(page.examples.empty()) << page.name;
    for (auto const& option : page.options) EXPECT_FALSE(option.meaning.empty()) << page.name << option.names.back();
  }
}

TEST(Completion, QuotesWhatAShellWouldObey) {
  EXPECT_THAT(zsh_completion({invented()}), HasSubstr("[it'\\''s \\[here\\]: $HOME]:R.h5:_files -g \"*.h5\"'"));
  EXPECT_THAT(fish_completion({invented()}),
              HasSubstr("-s o -l out -x -a '(__fish_complete_suffix .h5)' -d 'it\\'s ["));
  EXPECT_THAT(bash_completion({invented()}), HasSubstr("turn:-o | turn:--out) _torquescope_files .h5; return ;;"));
}

TEST(ManPage, HasNoRequestOfRoffInItsTexts) {
  std::string const page = command_man_page(invented());
  EXPECT_THAT(page, HasSubstr("torquescope\\-turn \\- turns a joint's file\n"));
  EXPECT_THAT(page, HasSubstr("\n\\&.hidden \\en\n"));
  EXPECT_THAT(page, HasSubstr("\n.SS results\n.TP\n\\fB\\-o\\fR, \\fB\\-\\-out\\fR \\fIR.h5\\fR\n"));
  EXPECT_EQ(man_page_file("turn"), "torquescope-turn.1");
  EXPECT_EQ(man_page_file(""), "torquescope.1");
}

}  // namespace shell_test
}  // namespace torquescope
