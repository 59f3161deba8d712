#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/app/commands/command.hpp"
#include "engine/app/commands/slurm_scripts.hpp"
#include "engine/app/result/result_summary.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"
#include "engine/base/error.hpp"
#include "engine/base/quantity_text.hpp"
#include "engine/workflows/diagnosis_standing.hpp"
#include "engine/workflows/results/diagnosis_reader.hpp"

namespace torquescope {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// "lab.h5", whether the result or its folder of segments was named
fs::path result_of(std::string name) {
  while (name.size() > 1 && name.back() == '/') name.pop_back();
  std::string const ending = ".parts";
  return name.ends_with(ending) ? name.substr(0, name.size() - ending.size()) : name;
}

int percent(JobStatus::Estimator const& estimator) {
  return estimator.generations > 0 ? static_cast<int>(100 * estimator.generations_done / estimator.generations) : 0;
}

// what is left to do, and by which command
std::string next_step(JobStatus const& status, fs::path const& result) {
  std::string const out = printable(shell_word(result.string()));
  bool const is_at_work =
      std::any_of(status.writers.begin(), status.writers.end(), [](auto const& writer) { return writer.is_alive; });
  bool const is_done = !status.estimators.empty() && status.damaged.empty() &&
                       std::all_of(status.estimators.begin(), status.estimators.end(),
                                   [](auto const& estimator) { return estimator.ended == estimator.runs; });
  if (is_done && is_at_work) return "every run that segments tell of is done";
  if (is_done)
    return "every run that segments tell of is done: torquescope merge JOB.toml --out " + out +
           " (a merge that Slurm holds for DependencyNeverSatisfied waits for ever: scancel it)";
  if (status.unfinished_shares.empty())
    return is_at_work ? "" : "no process of this host is at it; the same command goes on";
  constexpr std::size_t most = 12;
  std::vector<std::size_t> shown = status.unfinished_shares;
  bool const is_cut = shown.size() > most;
  if (is_cut) shown.resize(most);
  return fmt::format(
      "not finished: shards {}{} of {}. Those that no process or queue has any more: torquescope run JOB.toml --out {} "
      "--shard {}/{}; or `run` without --shard does all that is missing",
      fmt::join(shown, ", "), is_cut ? ", ..." : "", status.shares, out, shown.front(), status.shares);
}

std::string status_text(JobStatus const& status, fs::path const& result, Ink const& ink) {
  using Align = TextTable::Align;
  std::string text = fmt::format("{} is not finished: job {}, {} of segments\n", ink.name(printable(result.string())),
                                 printable(status.job_name), bytes_text(status.bytes));
  TextTable runs({Align::left, Align::right, Align::right, Align::right}, "  ");
  runs.row({"runs", "done", "begun", "generations"});
  for (auto const& estimator : status.estimators)
    runs.row({printable(estimator.label), fmt::format("{} of {}", estimator.ended, estimator.runs),
              std::to_string(estimator.begun), fmt::format("{} %", percent(estimator))});
  text += runs.text(page_width());
  TextTable writers({Align::left, Align::left, Align::right, Align::right, Align::left, Align::left}, "  ");
  writers.row({"shard", "host", "process", "segments", "last written (UTC)", ""});
  for (auto const& writer : status.writers)
    writers.row({fmt::format("{}/{}", writer.shard, writer.shards), printable(writer.host), std::to_string(writer.pid),
                 std::to_string(writer.segments), printable(writer.last_written), writer.is_alive ? "at work" : ""});
  text += writers.text(page_width());
  if (auto const next = next_step(status, result); !next.empty()) text += hanging("  ", next);
  for (auto const& name : status.damaged)
    text += hanging(ink.warning("warning") + "  ", printable(name) + " is damaged; its generations run again");
  return text;
}

std::string status_json(JobStatus const& status, fs::path const& result, bool complete) {
  Json estimators = Json::array(), writers = Json::array();
  for (auto const& e : status.estimators)
    estimators.push_back({{"name", e.label},
                          {"runs", e.runs},
                          {"done", e.ended},
                          {"begun", e.begun},
                          {"generations", e.generations},
                          {"generations_done", e.generations_done}});
  for (auto const& w : status.writers)
    writers.push_back({{"shard", w.shard},
                       {"shards", w.shards},
                       {"host", w.host},
                       {"pid", w.pid},
                       {"started", w.started},
                       {"last_written", w.last_written},
                       {"segments", w.segments},
                       {"alive_here", w.is_alive}});
  Json const document = {{"schema", 1},
                         {"file", result.string()},
                         {"complete", complete},
                         {"kind", "run"},
                         {"job", {{"name", status.job_name}, {"sha256", status.job_sha256}}},
                         {"segment_bytes", status.bytes},
                         {"estimators", estimators},
                         {"writers", writers},
                         {"damaged_segments", status.damaged},
                         {"unfinished_shards", status.unfinished_shares},
                         {"shards", status.shares}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// what a process told when its stage began: a stage counts nothing meanwhile
std::string standing_line(DiagnosisStanding const& one) {
  std::string line = one.shards > 1 ? fmt::format("shard {}/{}, ", one.shard, one.shards) : "";
  std::string const counted =
      one.total > 0 ? fmt::format(" ({} of {} {})", one.done, one.total, printable(one.counted)) : std::string();
  line += fmt::format("{}, {}: stage {}{}, reached {} after its beginning, at {}", printable(one.who),
                      one.is_alive ? "at work" : "not alive here", printable(one.stage), counted,
                      seconds_text(one.seconds), printable(one.told));
  if (one.expected_seconds > 0.0)
    line += fmt::format("; about {} were expected in all", seconds_text(one.expected_seconds));
  return line;
}

std::string diagnosis_status_text(std::vector<DiagnosisStanding> const& standings, fs::path const& result,
                                  Ink const& ink) {
  std::string const name = ink.name(printable(result.string()));
  std::string text = fmt::format("{} is not finished: a diagnosis{}\n", name,
                                 standings.empty() ? "" : ", job " + printable(standings.front().job));
  for (auto const& one : standings) text += hanging("  ", standing_line(one));
  bool const is_dead = std::none_of(standings.begin(), standings.end(), [](auto const& one) { return one.is_alive; });
  if (is_dead) text += "  no process of this host is at it; the same command begins anew\n";
  return text;
}

std::string diagnosis_status_json(std::vector<DiagnosisStanding> const& standings, fs::path const& result) {
  Json processes = Json::array();
  for (auto const& one : standings)
    processes.push_back({{"shard", one.shard},
                         {"shards", one.shards},
                         {"process", one.who},
                         {"alive_here", one.is_alive},
                         {"began", one.began},
                         {"told", one.told},
                         {"stage", one.stage},
                         {"counted", one.counted},
                         {"done", one.done},
                         {"total", one.total},
                         {"seconds", one.seconds},
                         {"expected_seconds", one.expected_seconds}});
  Json const document = {{"schema", 1},
                         {"file", result.string()},
                         {"complete", false},
                         {"kind", "diagnosis"},
                         {"job", {{"name", standings.empty() ? "" : standings.front().job}}},
                         {"processes", processes}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

ExitCode show_complete_diagnosis(fs::path const& result, ResultSummary const& summary, Session const& session) {
  look_at_result(result, [](ResultReader const& there) { read_diagnosis(there); });
  Diagnosis const diagnosis = read_diagnosis(ResultReader(result));
  session.result(fmt::format("{} is complete: a diagnosis, job {}, verdict {}   (torquescope show {})\n",
                             printable(result.string()), printable(summary.name), word(diagnosis.verdict),
                             printable(result.string())));
  Json const document = {{"schema", 1},
                         {"file", result.string()},
                         {"complete", true},
                         {"kind", "diagnosis"},
                         {"job", {{"name", summary.name}, {"sha256", summary.job_sha256}}},
                         {"verdict", word(diagnosis.verdict)}};
  session.document(document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return ExitCode::ok;
}

ExitCode show_status(std::string const& name, Session const& session) {
  fs::path const result = result_of(name), folder = segment_folder_of(result);
  bool const has_segments = fs::is_directory(folder);
  if (fs::exists(result)) {
    ResultSummary const summary = read_summary(result);
    if (summary.has_diagnosis) return show_complete_diagnosis(result, summary, session);
    if (!summary.is_partial() || !has_segments) {
      JobStatus status;
      status.job_name = summary.name;
      status.job_sha256 = summary.job_sha256;
      for (auto const& e : summary.estimators)
        status.estimators.push_back({e.name, e.runs, e.runs - e.missing_runs, 0, 0, 0});
      session.result(fmt::format("{} is {}: {} runs   (torquescope show {})\n", printable(result.string()),
                                 summary.is_partial() ? "partial" : "complete", summary.runs(),
                                 printable(result.string())));
      session.document(status_json(status, result, !summary.is_partial()));
      return ExitCode::ok;
    }
  }
  auto const standings = standings_in(folder);
  if (!standings.empty()) {
    session.result(diagnosis_status_text(standings, result, session.result_ink()));
    session.document(diagnosis_status_json(standings, result));
    return ExitCode::ok;
  }
  JobStatus const status = has_segments ? read_status(folder) : JobStatus{};
  validate(!status.writers.empty() || !status.damaged.empty(), [&] {
    return Problem{
        .code = ExitCode::no_input,
        .what = fmt::format("there is neither {} nor a segment in {}", result.string(), folder.string()),
        .help =
            "a run writes its first segment after 20 s (run --save-every), a diagnosis says how far it is from its "
            "beginning"};
  });
  session.result(status_text(status, result, session.result_ink()));
  session.document(status_json(status, result, false));
  return ExitCode::ok;
}

}  // namespace

void add_status(CLI::App& app, ChosenCommand& chosen) {
  auto const name = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("status", "Says how far a run or a diagnosis is, living or dead; changes nothing.");
  command->footer(
      "  torquescope status lab.h5\n"
      "  torquescope status lab.h5.parts --json -\n"
      "  watch -n 20 torquescope status lab.h5\n");
  command->add_option("R.h5", *name, "the result file, there or not yet, or its folder R.h5.parts")->required();
  add_json_option(*command, chosen);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback(
      [name, &chosen] { chosen.work = [name](Session const& session) { return show_status(*name, session); }; });
}

}  // namespace torquescope
