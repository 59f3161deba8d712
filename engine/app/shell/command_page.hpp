#pragma once
// The command line as plain records, read from the tables that parse it: completions and man pages are written from
// them, without CLI11.
//
// Threads    values

#include <string>
#include <vector>

namespace torquescope {

struct OptionPage {
  std::vector<std::string> names;  // "-o", "--out"
  std::string takes;               // "" for a flag; "R.h5", "N", "auto|bar|lines|none"
  std::string meaning;
  std::string group;  // heading on the help page
  bool is_required = false;
};

struct ArgumentPage {
  std::string name;   // "JOB.toml"
  std::string takes;  // like that of an option; often the name
  std::string meaning;
  bool is_required = false, repeats = false;
};

struct CommandPage {
  std::string name;
  std::string title;                  // sentences
  std::vector<std::string> examples;  // lines for a shell
  std::vector<ArgumentPage> arguments;
  std::vector<OptionPage> options;
};

// of every command, in the order of the help page
std::vector<CommandPage> command_pages();

// what a shell can offer for `takes`: files by their endings, any file, or words; nothing for numbers and free text
struct Offer {
  std::vector<std::string> endings{};  // ".h5"; folders are offered besides
  std::vector<std::string> words{};
  bool any_file = false;

  bool is_nothing() const { return endings.empty() && words.empty() && !any_file; }
};
Offer offer_for(std::string const& takes);

}  // namespace torquescope
