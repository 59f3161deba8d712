// Completion in zsh: _arguments of each command, with the meanings of the help page.

#include <fmt/format.h>

#include "engine/app/shell/completion.hpp"
#include "engine/base/version.hpp"

namespace torquescope {

namespace {

// `text` with a backslash before each of `special`; within single quotes of the script
std::string zsh_escaped(std::string const& text, std::string const& special) {
  std::string result;
  for (char const c : text) {
    if (c == '\'') {
      result += "'\\''";
      continue;
    }
    if (c == '\\' || special.find(c) != std::string::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_files(Offer const& offer) {
  if (offer.any_file) return "_files";
  std::vector<std::string> endings;
  for (auto const& ending : offer.endings) endings.push_back(ending.substr(1));
  // (h5) alone would be qualifiers of a pattern
  std::string const list = fmt::format("{}", fmt::join(endings, "|"));
  return fmt::format("_files -g \"*.{}\"", endings.size() == 1 ? list : "(" + list + ")");
}

// ":what it is:what is offered"; a blank offers nothing
std::string zsh_value(std::string const& takes) {
  Offer const offer = offer_for(takes);
  bool const has_files = offer.any_file || !offer.endings.empty();
  std::string const words = fmt::format("{}", fmt::join(offer.words, " "));
  if (offer.is_nothing()) return ":" + zsh_escaped(takes, ":") + ": ";
  if (!has_files) return ":word:(" + words + ")";
  if (offer.words.empty()) return ":" + zsh_escaped(takes, ":") + ":" + zsh_files(offer);
  return ":name or file:{_alternative \"names:name:(" + words + ")\" \"files:file:_files\"}";
}

std::string zsh_option(OptionPage const& option) {
  std::string const meaning = "[" + zsh_escaped(option.meaning, "[]") + "]";
  std::string const value = option.takes.empty() ? "" : zsh_value(option.takes);
  std::vector<std::string> names;
  for (auto const& name : option.names) {
    bool const is_long = name.starts_with("--");
    names.push_back(name + (option.takes.empty() ? "" : is_long ? "=" : "+"));
  }
  if (names.size() == 1) return fmt::format("'{}{}{}'", names.front(), meaning, value);
  return fmt::format("'({})'{{{}}}'{}{}'", fmt::join(option.names, " "), fmt::join(names, ","), meaning, value);
}

std::string zsh_argument(ArgumentPage const& argument) {
  std::string const lead = argument.repeats ? "*" : argument.is_required ? "" : ":";
  return fmt::format("'{}{}'", lead, zsh_value(argument.takes));
}

std::string zsh_case(CommandPage const& page) {
  std::string lines = fmt::format("    {})\n      _arguments -s", page.name);
  for (auto const& option : page.options) lines += " \\\n        " + zsh_option(option);
  for (auto const& argument : page.arguments) lines += " \\\n        " + zsh_argument(argument);
  return lines + " \\\n        '(- *)--help[the help page]' ;;\n";
}

}  // namespace

std::string zsh_completion(std::vector<CommandPage> const& pages) {
  std::string commands, cases;
  for (auto const& page : pages) {
    commands += fmt::format("    '{}:{}'\n", page.name, zsh_escaped(short_title(page), ""));
    cases += zsh_case(page);
  }
  return fmt::format(
             "#compdef torquescope\n# completion of torquescope {} in zsh; written by `torquescope completion "
             "zsh`\n\n_torquescope() {{\n  local -a subcommands\n  subcommands=(\n",
             version) +
         commands + "    'help:The help page of a command'\n  )\n" + R"(
  if ((CURRENT == 2)); then
    _describe command subcommands
    return
  fi
  local command=$words[2]
  # a command's own words: what _arguments reads
  shift words
  ((CURRENT--))
  case $command in
)" + cases +
         R"(    help) ((CURRENT == 2)) && _describe command subcommands ;;
  esac
}

# sourced, or autoloaded by its file's name
if [[ $funcstack[1] == _torquescope ]]; then
  _torquescope "$@"
else
  compdef _torquescope torquescope
fi
)";
}

}  // namespace torquescope
