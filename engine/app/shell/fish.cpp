// Completion in fish: one line for each option and argument of each command, with the meanings of the help page.

#include <fmt/format.h>

#include "engine/app/shell/completion.hpp"
#include "engine/base/version.hpp"

namespace torquescope {

namespace {

std::string fish_quoted(std::string const& text) {
  std::string result = "'";
  for (char const c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

// " -a '...'": words, and files with the right endings first
std::string fish_offer(std::string const& takes) {
  Offer const offer = offer_for(takes);
  std::vector<std::string> parts = offer.words;
  for (auto const& ending : offer.endings) parts.push_back("(__fish_complete_suffix " + ending + ")");
  std::string const text = parts.empty() ? "" : " -a " + fish_quoted(fmt::format("{}", fmt::join(parts, " ")));
  return offer.any_file ? " -F" + text : text;
}

std::string fish_option(CommandPage const& page, OptionPage const& option) {
  std::string line = fmt::format("complete -c torquescope -n '__torquescope_is {}'", page.name);
  for (auto const& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  // -r: files as well; -x: nothing but what is offered
  if (!option.takes.empty()) line += (offer_for(option.takes).any_file ? " -r" : " -x") + fish_offer(option.takes);
  return line + " -d " + fish_quoted(option.meaning) + "\n";
}

std::string fish_lines(CommandPage const& page) {
  std::string lines = fmt::format("complete -c torquescope -n __torquescope_is_bare -a {} -d {}\n", page.name,
                                  fish_quoted(short_title(page)));
  for (auto const& option : page.options) lines += fish_option(page, option);
  for (auto const& argument : page.arguments)
    if (auto const offer = fish_offer(argument.takes); !offer.empty())
      lines += fmt::format("complete -c torquescope -n '__torquescope_is {}'{}\n", page.name, offer);
  return lines +
         fmt::format("complete -c torquescope -n '__torquescope_is {}' -l help -d 'the help page'\n", page.name);
}

}  // namespace

std::string fish_completion(std::vector<CommandPage> const& pages) {
  std::string text =
      fmt::format("# completion of torquescope {} in fish; written by `torquescope completion fish`\n", version) + R"(
function __torquescope_is_bare
  test (count (commandline -opc)) -eq 1
end
function __torquescope_is
  set -l words (commandline -opc)
  test (count $words) -gt 1; and test $words[2] = $argv[1]
end

complete -c torquescope -f
complete -c torquescope -n __torquescope_is_bare -l help -d 'the help page'
complete -c torquescope -n __torquescope_is_bare -l version -d 'version, compiler and kind of build'
complete -c torquescope -n __torquescope_is_bare -a help -d 'The help page of a command'
)";
  text +=
      fmt::format("complete -c torquescope -n '__torquescope_is help' -a '{}'\n", fmt::join(first_words(pages), " "));
  for (auto const& page : pages) text += fish_lines(page);
  return text;
}

}  // namespace torquescope
