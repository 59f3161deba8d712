#pragma once
// What parsing the command line found. Apart from command.hpp, so that main.cpp reads neither CLI11 nor the engine.

#include <functional>

#include "engine/app/session.hpp"

namespace torquescope {

// Errors: throws Error; main() prints it and maps it to its exit code
using CommandWork = std::function<ExitCode(Session const&)>;

// options of every command, and the work of the one that was chosen
struct ChosenCommand {
  SessionOptions session{};
  CommandWork work{};
};

}  // namespace torquescope
