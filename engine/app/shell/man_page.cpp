#include "engine/app/shell/man_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "engine/app/exit_codes.hpp"
#include "engine/app/shell/completion.hpp"
#include "engine/base/version.hpp"

namespace torquescope {

namespace {

// a text as it stands: no sign of roff in it, its dashes those of a shell
std::string roff(std::string const& text) {
  std::string result;
  for (char const c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  bool const looks_like_request = result.starts_with(".") || result.starts_with("'");
  return looks_like_request ? "\\&" + result : result;
}

std::string roff_bold(std::string const& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string roff_italic(std::string const& text) { return "\\fI" + roff(text) + "\\fR"; }
std::string roff_item(std::string const& term, std::string const& meaning) {
  return ".TP\n" + term + "\n" + meaning + "\n";
}

std::string roff_head(std::string const& name, std::string const& what) {
  std::string capitals = name;
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return fmt::format(".TH {} 1 \"\" \"torquescope {}\" \"User commands\"\n.SH NAME\n{} \\- {}\n", roff(capitals),
                     version, roff(name), roff(what));
}

std::string roff_codes(std::span<ExitCodeMeaning const> codes) {
  std::string text;
  for (auto const& [code, words] : codes)
    text += roff_item(roff_bold(fmt::format("{}", static_cast<int>(code))), roff(words));
  return text;
}

std::string roff_synopsis(CommandPage const& page) {
  std::string line = roff_bold("torquescope " + page.name);
  for (auto const& argument : page.arguments) {
    std::string const name = roff_italic(argument.name) + (argument.repeats ? " ..." : "");
    line += argument.is_required ? " " + name : " [" + name + "]";
  }
  for (auto const& option : page.options)
    if (option.is_required) line += " " + roff_bold(option.names.back()) + " " + roff_italic(option.takes);
  return line + " [" + roff_italic("options") + "]\n";
}

std::string roff_option(OptionPage const& option) {
  std::string term;
  for (auto const& name : option.names) term += (term.empty() ? "" : ", ") + roff_bold(name);
  if (!option.takes.empty()) term += " " + roff_italic(option.takes);
  return roff_item(term, roff(option.meaning));
}

// in groups, each where its first option stands
std::string roff_options(CommandPage const& page) {
  std::vector<std::string> groups;
  for (auto const& option : page.options)
    if (std::find(groups.begin(), groups.end(), option.group) == groups.end()) groups.push_back(option.group);
  std::string text;
  for (auto const& group : groups) {
    text += ".SS " + roff(group) + "\n";
    for (auto const& option : page.options)
      if (option.group == group) text += roff_option(option);
  }
  return text;
}

bool tells_verdicts(CommandPage const& page) {
  return std::any_of(page.options.begin(), page.options.end(),
                     [](OptionPage const& option) { return option.names.back() == "--exit-code"; });
}

std::string with_small_letter(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace

std::string man_page_file(std::string const& command) {
  return command.empty() ? "torquescope.1" : "torquescope-" + command + ".1";
}

std::string command_man_page(CommandPage const& page) {
  std::string text = roff_head("torquescope-" + page.name, with_small_letter(short_title(page)));
  text += ".SH SYNOPSIS\n" + roff_synopsis(page) + ".SH DESCRIPTION\n" + roff(page.title) + "\n";
  for (auto const& argument : page.arguments) text += roff_item(roff_italic(argument.name), roff(argument.meaning));
  text += ".SH OPTIONS\n" + roff_options(page) + ".SH EXAMPLES\n.nf\n";
  for (auto const& line : page.examples) text += roff(line) + "\n";
  text += ".fi\n.SH EXIT STATUS\n";
  if (tells_verdicts(page))
    text += "With " + roff_bold("--exit-code") + ", when nothing failed:\n" + roff_codes(verdict_codes()) +
            ".PP\nOtherwise:\n";
  return text + roff_codes(exit_codes()) + ".SH SEE ALSO\n.BR torquescope (1)\n";
}

std::string program_man_page(std::vector<CommandPage> const& pages) {
  std::string text =
      roff_head("torquescope", "identifies robot dynamics from recordings and names the physics a model lacks");
  text += ".SH SYNOPSIS\n" + roff_bold("torquescope") + " " + roff_italic("command") + " [" + roff_italic("arguments") +
          "]\n.br\n" + roff_bold("torquescope help") + " [" + roff_italic("command") + "]\n.br\n" +
          roff_bold("torquescope --version") + "\n.SH DESCRIPTION\n" +
          roff(
              "Recordings of position and torque, and a job file that says what model to fit, go in; parameters, a "
              "verdict on missing physics and a page with pictures come out.") +
          "\n.SH COMMANDS\n";
  std::string see;
  for (auto const& page : pages) {
    text += roff_item(roff_bold(page.name), roff(page.title));
    see += fmt::format("{}.BR torquescope\\-{} (1)", see.empty() ? "" : ",\n", page.name);
  }
  return text + ".SH EXIT STATUS\n" + roff_codes(exit_codes()) + ".SH SEE ALSO\n" + see + "\n";
}

}  // namespace torquescope
