#pragma once
// Words of the command line to the command that was chosen, or to a Problem with exit code 64.

#include <optional>
#include <string>
#include <vector>

#include "engine/app/commands/chosen_command.hpp"

namespace torquescope {

// what to do: print a text and be done (help, version), or the work of a command
struct ParsedCommandLine {
  std::optional<std::string> text{};
  ChosenCommand chosen{};
};

// `given` without the program's name. Errors: Error 64 (unknown command or option, missing or bad value)
void parse_command_line(std::vector<std::string> const& given, ParsedCommandLine& parsed);

// --color and --json as far as they can be seen in words that may not parse: an error must already obey them
SessionOptions session_options_of(std::vector<std::string> const& words);

}  // namespace torquescope
