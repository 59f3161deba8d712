#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>

#include "engine/app/commands/all_commands.hpp"
#include "engine/app/commands/command.hpp"
#include "engine/app/shell/man_page.hpp"

namespace torquescope {

namespace {

struct ManArguments {
  std::string command{}, folder{};
};

void write_man_page(std::filesystem::path const& file, std::string const& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  validate(stream.good(), [&] {
    return Problem{.code = ExitCode::io,
                   .what = file.string() + " cannot be written",
                   .help = "--into names a folder that exists; look at the disk"};
  });
}

std::string one_page(std::vector<CommandPage> const& pages, std::string const& name) {
  if (name.empty()) return program_man_page(pages);
  auto const page = std::find_if(pages.begin(), pages.end(), [&](CommandPage const& one) { return one.name == name; });
  validate(page != pages.end(), [&] {
    Problem problem{.code = ExitCode::usage, .what = fmt::format("there is no command \"{}\"", name)};
    if (auto const close = closest_name(name, command_names()); !close.empty())
      problem.what += fmt::format("; did you mean \"{}\"?", close);
    problem.help = "torquescope --help shows every command";
    return problem;
  });
  return command_man_page(*page);
}

ExitCode write_man(ManArguments const& arguments, Session const& session) {
  auto const pages = command_pages();
  if (arguments.folder.empty()) {
    session.verdict(one_page(pages, arguments.command));
    return ExitCode::ok;
  }
  std::filesystem::path const folder = arguments.folder;
  write_man_page(folder / man_page_file(""), program_man_page(pages));
  for (auto const& page : pages) write_man_page(folder / man_page_file(page.name), command_man_page(page));
  return ExitCode::ok;
}

}  // namespace

void add_man(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<ManArguments>();
  CLI::App* command = app.add_subcommand("man", "Prints the man page of the program or of a command, as roff.");
  command->footer(
      "  torquescope man run | man -l -\n"
      "  torquescope man > torquescope.1\n"
      "  torquescope man --into ~/.local/share/man/man1\n");
  command->add_option("COMMAND", arguments->command, "whose page [that of the program]")
      ->type_name(fmt::format("{}", fmt::join(command_names(), "|")));
  command->add_option("--into", arguments->folder, "write every page into this folder, over those that are there")
      ->type_name("FOLDER")
      ->group("results");
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return write_man(*arguments, session); };
  });
}

}  // namespace torquescope
