#include "engine/app/commands/all_commands.hpp"

#include "engine/app/commands/command.hpp"

namespace torquescope {

namespace {

constexpr Command every_command[] = {
    {"init", add_init},
    {"check", add_check},
    {"run", add_run},
    {"diagnose", [](CLI::App& app, ChosenCommand& chosen) { add_diagnose(app, chosen, diagnose); }},
    {"replay", add_replay},
    {"show", add_show},
    {"report", add_report},
    {"compare", add_compare},
    {"export", add_export},
    {"merge", add_merge},
    {"status", add_status},
    {"submit", add_submit},
    {"simulate", add_simulate},
    {"excite", add_excite},
    {"list", add_list},
    {"describe", add_describe},
    {"completion", add_completion},
    {"man", add_man},
};

}  // namespace

std::span<Command const> all_commands() { return every_command; }

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (auto const& command : every_command) names.emplace_back(command.name);
  return names;
}

}  // namespace torquescope
