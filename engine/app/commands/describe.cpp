#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "engine/app/commands/command.hpp"
#include "engine/app/result/catalogue_json.hpp"
#include "engine/app/result/robot_json.hpp"
#include "engine/app/result/robot_text.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"
#include "engine/experiment/catalogue.hpp"
#include "engine/experiment/robot_description.hpp"

namespace torquescope {

namespace {

constexpr int widest_cell = 16;

// long ranges and defaults go to the meaning, where lines may break
std::string option_text(std::vector<OptionDescription> const& options) {
  using Align = TextTable::Align;
  TextTable table({Align::left, Align::left, Align::left, Align::left}, "  ");
  table.row({"key", "default", "takes", "meaning"});
  for (auto const& option : options) {
    std::string meaning = option.meaning;
    std::string const unit = option.unit == "1" ? "" : option.unit;
    std::string takes = option.range.empty() ? option.type : option.range;
    if (!unit.empty()) takes += " " + unit;
    if (columns_of(takes) > widest_cell) {
      meaning += fmt::format("; {}", option.range.empty() ? takes : "takes " + takes);
      takes = columns_of(option.type) > widest_cell ? "" : option.type;
    }
    std::string standard = option.default_value;
    if (columns_of(standard) > widest_cell) {
      meaning += fmt::format("; default {}", standard);
      standard = "";
    }
    table.row({option.key, standard, takes, meaning});
  }
  return table.text(page_width());
}

std::string entry_text(CatalogueEntry const& entry, Ink const& ink) {
  std::string text = hanging(ink.bold(entry.name) + "  ", fmt::format("{} ({})", entry.title, entry.kind));
  for (auto const& line : entry.text) text += hanging("  ", printable(line));
  if (!entry.options.empty()) text += "\n" + option_text(entry.options);
  return text;
}

ExitCode describe_entry(std::string const& name, Session const& session) {
  std::string text;
  std::vector<std::string> names;
  std::vector<CatalogueEntry> described;  // several where kinds share a name
  for (auto const& entry : catalogue()) {
    names.push_back(entry.name);
    if (entry.name != name) continue;
    text += (text.empty() ? "" : "\n") + entry_text(entry, session.result_ink());
    described.push_back(entry);
  }
  validate(!described.empty(), [&] {
    Problem problem;
    problem.code = ExitCode::usage;
    problem.what = fmt::format("nothing is called \"{}\"", name);
    if (std::string const close = closest_name(name, names); !close.empty())
      problem.what += fmt::format("; did you mean \"{}\"?", close);
    problem.help = "torquescope list shows every name";
    return problem;
  });
  session.result(text);
  session.document(describe_json(described));
  return ExitCode::ok;
}

bool is_file_name(std::string const& name) {
  auto const ending = std::filesystem::path(name).extension();
  return name.find('/') != std::string::npos || ending == ".toml" || ending == ".urdf" || ending == ".xml" ||
         ending == ".xacro" || std::filesystem::is_regular_file(name);
}

// "fade|stribeck|...|FILE", for shells
std::string names_and_file() {
  std::set<std::string> names;
  for (auto const& entry : catalogue()) names.insert(entry.name);
  return fmt::format("{}|FILE", fmt::join(names, "|"));
}

ExitCode describe(std::string const& name, RobotPart const& part, Session const& session) {
  bool const is_entry =
      std::any_of(catalogue().begin(), catalogue().end(), [&](auto const& one) { return one.name == name; });
  if (is_entry || !is_file_name(name)) return describe_entry(name, session);
  RobotDescription const robot = describe_robot(name, part);
  session.result(robot_text(robot, session.result_ink()));
  session.document(robot_json(robot));
  return ExitCode::ok;
}

}  // namespace

void add_describe(CLI::App& app, ChosenCommand& chosen) {
  auto const name = std::make_shared<std::string>();
  auto const part = std::make_shared<RobotPart>();
  CLI::App* command = app.add_subcommand("describe", "Explains one name with every option, or the robot in a file.");
  command->footer(
      "  torquescope describe fade\n"
      "  torquescope describe recording --json - | jq -r .entries[].options[].key\n"
      "  torquescope describe go2.urdf --tip FL_foot\n");
  command->add_option("NAME", *name, "effect, optimiser, reader, loss, estimator, job section, or a robot file")
      ->required()
      ->type_name(names_and_file());
  command->add_option("--root", part->root, "link of the robot that stands still, with all before it")
      ->type_name("LINK");
  command->add_option("--tip", part->tip, "link of the robot where the arm ends")->type_name("LINK");
  add_json_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([name, part, &chosen] {
    chosen.work = [name, part](Session const& session) { return describe(*name, *part, session); };
  });
}

}  // namespace torquescope
