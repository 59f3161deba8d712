#include "engine/app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>

#include "engine/app/commands/all_commands.hpp"
#include "engine/app/help_page.hpp"
#include "engine/base/version.hpp"

namespace torquescope {

namespace {

Error usage_error(std::string what, std::string help) {
  Problem problem;
  problem.code = ExitCode::usage;
  problem.what = std::move(what);
  problem.help = std::move(help);
  return Error(problem);
}

std::string with_suggestion(std::string const& what, std::string const& close) {
  return close.empty() ? what : what + fmt::format("; did you mean \"{}\"?", close);
}

Error unknown_option(CLI::App& command, std::string const& word) {
  std::string const help = fmt::format("torquescope {} --help", command.get_name());
  if (word.rfind("-", 0) != 0)
    return usage_error(fmt::format("\"{}\" is one argument too many for {}", word, command.get_name()), help);
  std::string const name = word.substr(0, word.find('='));
  std::vector<std::string> names;
  for (auto const* option : command.get_options([](CLI::Option const* o) { return !o->get_positional(); }))
    for (auto const& long_name : option->get_lnames()) names.push_back("--" + long_name);
  return usage_error(
      with_suggestion(fmt::format("{} has no option \"{}\"", command.get_name(), name), closest_name(name, names)),
      help);
}

// "JOB.toml is required" stays, "Could not convert: --threads = x" becomes lower case
std::string plain_words(std::string text) {
  bool const starts_a_sentence =
      text.size() > 1 && text[0] >= 'A' && text[0] <= 'Z' && text[1] >= 'a' && text[1] <= 'z';
  if (starts_a_sentence) text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

// "help run" is "run --help"
std::vector<std::string> without_help_word(std::vector<std::string> const& words) {
  if (words.size() < 2 || words.front() != "help") return words;
  if (words.size() > 2)
    throw usage_error(fmt::format("\"{}\" is one argument too many for help", words[2]), "torquescope help COMMAND");
  return {words[1], "--help"};
}

}  // namespace

void parse_command_line(std::vector<std::string> const& given, ParsedCommandLine& parsed) {
  std::vector<std::string> const words = without_help_word(given);
  CLI::App app("", "torquescope");
  app.formatter(std::make_shared<HelpPage>());
  if (words.empty()) throw usage_error("no command", "torquescope --help shows them all");
  std::string const& first = words.front();
  if (first == "--help" || first == "-h" || first == "help") {
    parsed.text = program_help();
    return;
  }
  if (first == "--version" || first == "-V") {
    parsed.text = fmt::format("torquescope {} ({}, {})\n", version, compiler, build_type);
    return;
  }
  auto const commands = all_commands();
  auto const named =
      std::find_if(commands.begin(), commands.end(), [&](Command const& command) { return command.name == first; });
  if (named == commands.end())
    throw usage_error(
        with_suggestion(fmt::format("unknown command \"{}\"", first), closest_name(first, command_names())),
        "torquescope --help shows every command");

  // the others stay out: their options take 0.3 ms to make
  named->add(app, parsed.chosen);
  CLI::App& command = *app.get_subcommand(first);
  try {
    // the parser takes the words from the back
    std::vector<std::string> reversed(words.rbegin(), words.rend());
    app.parse(reversed);
  } catch (CLI::CallForHelp const&) {
    parsed.text = app.help();
  } catch (CLI::ExtrasError const&) {
    auto const left = command.remaining(true);
    throw unknown_option(command, left.empty() ? "?" : left.front());
  } catch (CLI::RequiredError const& error) {
    throw usage_error(fmt::format("{}: {}", first, plain_words(error.what())),
                      fmt::format("torquescope {} --help", first));
  } catch (CLI::ParseError const& error) {
    throw usage_error(plain_words(error.what()), fmt::format("torquescope {} --help", first));
  }
}

SessionOptions session_options_of(std::vector<std::string> const& words) {
  SessionOptions options;
  auto const value_of = [&](std::string const& name) -> std::string {
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] == name && i + 1 < words.size()) return words[i + 1];
      if (words[i].rfind(name + "=", 0) == 0) return words[i].substr(name.size() + 1);
    }
    return "";
  };
  std::string const colour = value_of("--color");
  if (colour == "always") options.colour = ColourChoice::always;
  if (colour == "never") options.colour = ColourChoice::never;
  options.json = value_of("--json");
  return options;
}

}  // namespace torquescope
