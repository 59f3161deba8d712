#include "engine/app/help_page.hpp"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <vector>

#include "engine/app/exit_codes.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"

namespace torquescope {

std::string program_help() {
  std::string codes;
  for (auto const& [code, words] : exit_codes())
    codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", static_cast<int>(code), words);
  return R"(Torquescope identifies robot joints from recordings of position and torque.

  torquescope init     REC.csv > JOB.toml    a job for your own recording
  torquescope check    JOB.toml      is everything there?       (seconds)
  torquescope run      JOB.toml      identify; killed? run it again: it goes on
  torquescope diagnose JOB.toml      find the physics the model lacks
  torquescope show     R.h5          tables here
  torquescope report   R.h5          one page with pictures
  torquescope compare  A.h5 B.h5     results side by side on one page
  torquescope export   R.h5 --urdf FILE           an arm as URDF, TOML, ...
  torquescope simulate JOB.toml --out REC.csv     recordings from a model
  torquescope excite   JOB.toml --out REF.csv     a motion that tells most
  torquescope submit   JOB.toml --shards N        the same on a Slurm cluster
  torquescope merge    JOB.toml      one result of all shards
  torquescope status   R.h5          how far a job is, living or dead
  torquescope list     [effects|optimisers|readers|losses|estimators|sections]
  torquescope describe NAME          what it does, every option
  torquescope completion bash|zsh|fish            for your shell; man: man pages

start: torquescope run jobs/smoke.toml
more:  torquescope help COMMAND, torquescope --version
)" + hanging("exit:  ", codes);
}

namespace {

// "-o, --out"
std::string shown_name(CLI::Option const& option) {
  std::string text;
  for (auto const& letter : option.get_snames()) text += "-" + letter + ", ";
  return text + option.get_name();
}

}  // namespace

std::string HelpPage::make_help(CLI::App const* command, std::string name, CLI::AppFormatMode) const {
  std::string text = hanging("", command->get_description());
  std::string usage = command->get_name();
  for (auto const* option : command->get_options([](CLI::Option const* o) { return o->get_positional(); }))
    usage += option->get_required() ? " " + option->get_name() : " [" + option->get_name() + "]";
  for (auto const* option : command->get_options([](CLI::Option const* o) { return !o->get_positional(); }))
    if (option->get_required()) usage += " " + option->get_name() + " " + option->get_type_name();
  text += "\n" + hanging("usage: ", name.substr(0, name.find(' ')) + " " + usage + " [options]");
  text += "\n" + command->get_footer() + "\n";

  // one table, so that all groups share their columns; whoever reads this knows --help
  using Align = TextTable::Align;
  TextTable table({Align::left, Align::left}, "  ");
  std::vector<std::string> groups;
  auto const visible = command->get_options(
      [command](CLI::Option const* o) { return o != command->get_help_ptr() && !o->get_group().empty(); });
  auto const group_of = [](CLI::Option const* option) {
    return option->get_positional() ? std::string("files and names") : option->get_group();
  };
  for (auto const* option : visible)
    if (std::find(groups.begin(), groups.end(), group_of(option)) == groups.end()) groups.push_back(group_of(option));
  std::vector<int> rows_before_group;
  for (auto const& group : groups) {
    rows_before_group.push_back(table.row_count());
    for (auto const* option : visible) {
      if (group_of(option) != group) continue;
      bool const is_flag = option->get_type_size() == 0 || option->get_positional();
      table.row({shown_name(*option) + (is_flag ? "" : " " + option->get_type_name()), option->get_description()});
    }
  }
  std::string const rows = table.text(page_width());

  // headings between the rows: a new row begins two spaces in, a continued one further right
  std::size_t next_group = 0;
  int row = 0;
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t const end = rows.find('\n', begin) + 1;
    bool const is_new_row = rows.compare(begin, 3, "   ") != 0;
    if (is_new_row) {
      if (next_group < groups.size() && row == rows_before_group[next_group]) text += groups[next_group++] + "\n";
      ++row;
    }
    text += rows.substr(begin, end - begin);
    begin = end;
  }
  return text;
}

}  // namespace torquescope
