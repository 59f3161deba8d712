// Completion in bash, which needs no package of completions: a case for what may stand behind each option, the options
// of each command, and what its arguments are.

#include <fmt/format.h>

#include "engine/app/shell/completion.hpp"
#include "engine/base/version.hpp"

namespace torquescope {

namespace {

constexpr char const* bash_helpers = R"(
_torquescope_words() {
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$1" -- "$cur")
}

# folders, and files with one of the endings; all files where none is given
_torquescope_files() {
  local ending
  compopt -o filenames 2>/dev/null
  if (($# == 0)); then
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$cur")
    return
  fi
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$cur")
  for ending; do
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -X "!*$ending" -- "$cur")
  done
}

_torquescope() {
  local cur=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  # --out=R.h5 is three words
  if [[ $cur == "=" ]]; then
    cur=
  elif [[ $before == "=" ]]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  COMPREPLY=()
)";

// one line of a case: what is offered
std::string bash_offer(std::string const& takes) {
  Offer const offer = offer_for(takes);
  std::vector<std::string> calls;
  if (!offer.words.empty()) calls.push_back(fmt::format("_torquescope_words \"{}\"", fmt::join(offer.words, " ")));
  if (offer.any_file)
    calls.emplace_back("_torquescope_files");
  else if (!offer.endings.empty())
    calls.push_back(fmt::format("_torquescope_files {}", fmt::join(offer.endings, " ")));
  return fmt::format("{}", fmt::join(calls, "; "));
}

std::string bash_values(CommandPage const& page) {
  std::string lines;
  for (auto const& option : page.options) {
    if (option.takes.empty()) continue;
    std::vector<std::string> patterns;
    for (auto const& name : option.names) patterns.push_back(page.name + ":" + name);
    std::string const offer = bash_offer(option.takes);
    lines += fmt::format("    {}) {}return ;;\n", fmt::join(patterns, " | "), offer.empty() ? "" : offer + "; ");
  }
  return lines;
}

std::string bash_names(CommandPage const& page) {
  std::vector<std::string> names;
  for (auto const& option : page.options) names.insert(names.end(), option.names.begin(), option.names.end());
  names.emplace_back("--help");
  return fmt::format("      {}) _torquescope_words \"{}\" ;;\n", page.name, fmt::join(names, " "));
}

std::string bash_arguments(CommandPage const& page) {
  std::vector<std::string> offers;
  for (auto const& argument : page.arguments)
    if (auto const offer = bash_offer(argument.takes); !offer.empty()) offers.push_back(offer);
  return offers.empty() ? "" : fmt::format("    {}) {} ;;\n", page.name, fmt::join(offers, "; "));
}

}  // namespace

std::string bash_completion(std::vector<CommandPage> const& pages) {
  std::string values, names, arguments;
  for (auto const& page : pages) {
    values += bash_values(page);
    names += bash_names(page);
    arguments += bash_arguments(page);
  }
  std::string const commands = fmt::format("{}", fmt::join(first_words(pages), " "));
  return fmt::format("# completion of torquescope {} in bash; written by `torquescope completion bash`\n", version) +
         bash_helpers +
         fmt::format(
             "  if ((COMP_CWORD == 1)); then\n    _torquescope_words \"{} --help --version\"\n    return\n  fi\n",
             commands) +
         "  case $command:$before in\n" + values + "  esac\n" + "  if [[ $cur == -* ]]; then\n    case $command in\n" +
         names + "    esac\n    return\n  fi\n" + "  case $command in\n" + arguments +
         fmt::format("    help) _torquescope_words \"{}\" ;;\n", commands) +
         "  esac\n}\n\ncomplete -F _torquescope torquescope\n";
}

}  // namespace torquescope
