#include "engine/app/shell/command_page.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <sstream>

#include "engine/app/commands/all_commands.hpp"

namespace torquescope {

namespace {

// CLI11's own word for a text without a type
std::string const untyped = "TEXT";

ArgumentPage argument_page(CLI::Option const& option) {
  std::string const name = option.get_name(), type = option.get_type_name();
  return {.name = name,
          .takes = type == untyped ? name : type,
          .meaning = option.get_description(),
          .is_required = option.get_required(),
          .repeats = option.get_items_expected_max() > 1};
}

OptionPage option_page(CLI::Option const& option) {
  OptionPage page{.names = {},
                  .takes = option.get_type_size() == 0 ? "" : option.get_type_name(),
                  .meaning = option.get_description(),
                  .group = option.get_group(),
                  .is_required = option.get_required()};
  for (auto const& letter : option.get_snames()) page.names.push_back("-" + letter);
  for (auto const& name : option.get_lnames()) page.names.push_back("--" + name);
  return page;
}

std::vector<std::string> trimmed_lines(std::string const& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (auto const begin = line.find_first_not_of(' '); begin != std::string::npos) lines.push_back(line.substr(begin));
  return lines;
}

CommandPage page_of(Command const& one) {
  CLI::App app("", "torquescope");
  ChosenCommand chosen;
  one.add(app, chosen);
  CLI::App const* const command = app.get_subcommand(one.name);
  CommandPage page{.name = one.name,
                   .title = command->get_description(),
                   .examples = trimmed_lines(command->get_footer()),
                   .arguments = {},
                   .options = {}};
  for (auto const* option : command->get_options()) {
    if (option == command->get_help_ptr()) continue;
    if (option->get_positional())
      page.arguments.push_back(argument_page(*option));
    else
      page.options.push_back(option_page(*option));
  }
  return page;
}

bool is_word(std::string const& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

}  // namespace

std::vector<CommandPage> command_pages() {
  std::vector<CommandPage> pages;
  for (auto const& command : all_commands()) pages.push_back(page_of(command));
  return pages;
}

Offer offer_for(std::string const& takes) {
  Offer offer;
  std::istringstream stream(takes);
  for (std::string part; std::getline(stream, part, '|');) {
    if (part == "FILE" || part == "FOLDER")
      offer.any_file = true;
    else if (auto const dot = part.rfind('.'); dot != std::string::npos)
      offer.endings.push_back(part.substr(dot));
    else if (is_word(part))
      offer.words.push_back(part);
  }
  return offer;
}

}  // namespace torquescope
