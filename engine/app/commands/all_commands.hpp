#pragma once
// Every command, in the order of the help page: what the command line is read with, and what help, completions and man
// pages are written from.

#include <CLI/App.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/app/commands/chosen_command.hpp"

namespace torquescope {

struct Command {
  char const* name;
  void (*add)(CLI::App&, ChosenCommand&);
};

std::span<Command const> all_commands();
std::vector<std::string> command_names();

}  // namespace torquescope
