#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/app/commands/command.hpp"
#include "engine/app/commands/notes.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/experiment/foreign_file.hpp"
#include "engine/workflows/servo_workflow.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

namespace {

using Json = nlohmann::ordered_json;

bool warns(CheckLine const& line) { return line.level == CheckLine::Level::warn; }
bool is_fault(CheckLine const& line) { return line.level == CheckLine::Level::fault; }

char const* level_word(CheckLine const& line) {
  switch (line.level) {
    case CheckLine::Level::ok:
      return "ok";
    case CheckLine::Level::note:
      return "note";
    case CheckLine::Level::warn:
      return "warn";
    case CheckLine::Level::fault:
      return "fault";
  }
  return "";
}

std::string check_text(std::vector<CheckLine> const& lines, Ink const& ink) {
  std::size_t topic_width = 13;
  for (auto const& line : lines) topic_width = std::max(topic_width, line.topic.size() + 1);
  std::string text;
  for (auto const& line : lines) {
    std::string const word = level_word(line);
    std::string const blanks(6 - word.size(), ' ');
    std::string const level = (warns(line) || is_fault(line) ? ink.warning(word) : word) + blanks;
    text +=
        hanging(level + pad_right(printable(line.topic), static_cast<int>(topic_width)) + " ", printable(line.text));
  }
  auto const warnings = std::count_if(lines.begin(), lines.end(), warns);
  auto const faults = std::count_if(lines.begin(), lines.end(), is_fault);
  text += fmt::format("{} warning{}, ", warnings, warnings == 1 ? "" : "s");
  if (faults == 0) return text + "nothing stops a run\n";
  return text + fmt::format("{} fault{} of the recording: `run` refuses it\n", faults, faults == 1 ? "" : "s");
}

std::string check_json(std::string const& name, std::string const& job, std::vector<CheckLine> const& lines) {
  Json list = Json::array();
  for (auto const& line : lines)
    list.push_back({{"level", level_word(line)}, {"topic", line.topic}, {"text", line.text}});
  Json const document = {{"schema", 1},
                         {"file", job},
                         {"job", name},
                         {"warnings", std::count_if(lines.begin(), lines.end(), warns)},
                         {"faults", std::count_if(lines.begin(), lines.end(), is_fault)},
                         {"lines", list}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

struct CheckedJob {
  std::string name;
  std::vector<CheckLine> lines;
};

CheckedJob checked(std::string const& file, Session const& session) {
  if (Job job = read_job_file(file); has_recording_set(job)) {
    ServoJob const servo = read_servo_job(std::move(job));
    return {servo.experiment.name, check_servo(servo)};
  }
  Experiment const experiment = load_with_bar(session, file, Experiment::Purpose::check);
  return {experiment.name(), experiment.check(choose_threads(0).count)};
}

ExitCode check_job(std::string const& job, Session const& session) {
  auto const [name, lines] = checked(job, session);
  session.result(check_text(lines, session.result_ink()));
  session.document(check_json(name, job, lines));
  return std::any_of(lines.begin(), lines.end(), is_fault) ? ExitCode::bad_data : ExitCode::ok;
}

}  // namespace

void add_check(CLI::App& app, ChosenCommand& chosen) {
  auto const job = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("check", "Finds everything that can be refused before a run, and says what looks odd.");
  command->footer(
      "  torquescope check jobs/crs_a465_joint.toml\n"
      "  torquescope check lab.toml --json check.json\n"
      "  torquescope check lab.toml && torquescope run lab.toml\n");
  command->add_option("JOB.toml", *job, "job file, TOML (torquescope list sections)")->required();
  add_json_option(*command, chosen);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback(
      [job, &chosen] { chosen.work = [job](Session const& session) { return check_job(*job, session); }; });
}

}  // namespace torquescope
