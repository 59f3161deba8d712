#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <iterator>
#include <memory>

#include "engine/app/commands/command.hpp"
#include "engine/app/shell/completion.hpp"

namespace torquescope {

namespace {

std::string shell_words(char const* between) {
  std::vector<std::string> names;
  for (auto const& shell : shells) names.emplace_back(shell.name);
  return fmt::format("{}", fmt::join(names, between));
}

ExitCode print_completion(std::string const& name, Session const& session) {
  auto const* const shell =
      std::find_if(std::begin(shells), std::end(shells), [&](Shell const& one) { return one.name == name; });
  validate(shell != std::end(shells), [&] {
    return Problem{.code = ExitCode::usage,
                   .what = fmt::format("there is no completion for \"{}\"", name),
                   .help = "torquescope completion " + shell_words("|")};
  });
  session.verdict(shell->completion(command_pages()));
  return ExitCode::ok;
}

}  // namespace

void add_completion(CLI::App& app, ChosenCommand& chosen) {
  auto const shell = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("completion", "Prints the script that completes this command line in a shell.");
  command->footer(
      "  source <(torquescope completion bash)\n"
      "  torquescope completion zsh > ~/.zfunc/_torquescope\n"
      "  torquescope completion fish | source\n");
  command->add_option("SHELL", *shell, shell_words(", "))->required()->type_name(shell_words("|"));
  add_colour_option(*command, chosen);
  command->callback([shell, &chosen] {
    chosen.work = [shell](Session const& session) { return print_completion(*shell, session); };
  });
}

}  // namespace torquescope
