#pragma once
// The help pages: examples first, one screen, no line over 80 columns.

#include <CLI/App.hpp>
#include <CLI/FormatterFwd.hpp>
#include <string>

namespace torquescope {

std::string program_help();  // torquescope --help

// torquescope run --help: title, usage, three examples (the command's footer), then its options in groups
class HelpPage : public CLI::Formatter {
 public:
  std::string make_help(CLI::App const* command, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace torquescope
