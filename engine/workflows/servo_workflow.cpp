#include "engine/workflows/servo_workflow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/base/error.hpp"

namespace torquescope {
namespace {

Replay replay_of(ServoJob const& job, ServoQuestion const& question, ServoDecision const& decision) {
  Replay replay;
  bool const has_names = !decision.facts.kept.empty();
  replay.models = has_names ? std::vector<std::string>{"job's model", "with what was named"}
                            : std::vector<std::string>{"job's model"};
  replay.after = has_names ? 1 : 0;
  std::vector<RolloutModel> models{decision.model(question, decision.base)};
  if (has_names) models.push_back(decision.model(question, decision.final));
  for (std::size_t k = 0; k < job.entries.size(); ++k) {
    RolloutTrack const& track = job.track(k);
    std::vector<ReplayedModel> replayed;
    for (auto const& model : models)
      replayed.push_back({model.structure_for(model.start(), track.tick_s()), model.trial(model.start())});
    RecordingReplay one = replay_recording(job.recordings[k], track, {}, replayed);
    if (!job.has_torque) one.channels[2] = {};
    one.is_validation = job.entries[k].is_validation;
    one.loop = "given";
    one.loop_words = fmt::format("controller {} as the job gives it", word(question.loop.form));
    replay.recordings.push_back(std::move(one));
  }
  return replay;
}

void add(ServoError& error, Replay const& replay, std::size_t recording) {
  auto const& errors = replay.recordings[recording].channels[0].errors;
  auto const more = static_cast<double>(errors.front().samples), so_far = static_cast<double>(error.samples);
  auto const mean = [&](double before, double here) { return (so_far * before + more * here) / (so_far + more); };
  error.before = mean(error.before, errors[replay.before].mae);
  error.after = mean(error.after, errors[replay.after].mae);
  error.samples += errors.front().samples;
  ++error.recordings;
}

std::string value_of(SetEntry const& entry, std::string const& quantity) {
  if (auto const word = entry.words.find(quantity); word != entry.words.end()) return word->second;
  auto const number = entry.numbers.find(quantity);
  return number == entry.numbers.end() ? std::string() : fmt::format("{:g}", number->second);
}

// quantities that have more than one value, and not one a recording
std::vector<std::string> told_apart_by(std::vector<SetEntry> const& entries) {
  std::set<std::string> names;
  for (auto const& entry : entries) {
    for (auto const& [name, value] : entry.numbers) names.insert(name);
    for (auto const& [name, value] : entry.words) names.insert(name);
  }
  std::vector<std::string> told;
  constexpr std::size_t most_values = 24;
  for (auto const& name : names) {
    std::set<std::string> values;
    for (auto const& entry : entries) values.insert(value_of(entry, name));
    bool const is_one_each = values.size() == entries.size() && entries.size() > 2;
    if (values.size() > 1 && values.size() <= most_values && !is_one_each) told.push_back(name);
  }
  return told;
}

// numbers by their size, words by their letters
std::vector<std::string> values_of(std::vector<SetEntry> const& entries, std::string const& quantity) {
  std::set<std::pair<double, std::string>> values;
  for (auto const& entry : entries) {
    auto const number = entry.numbers.find(quantity);
    std::string const value = value_of(entry, quantity);
    if (!value.empty()) values.insert({number == entry.numbers.end() ? 0.0 : number->second, value});
  }
  std::vector<std::string> sorted;
  for (auto const& one : values) sorted.push_back(one.second);
  return sorted;
}

ServoTable table_by(std::string const& quantity, ServoReport const& report) {
  ServoTable table{quantity, {}};
  for (auto const& value : values_of(report.entries, quantity)) {
    ServoRow row{value, {}, {}};
    for (std::size_t k = 0; k < report.entries.size(); ++k)
      if (value_of(report.entries[k], quantity) == value)
        add(report.entries[k].is_validation ? row.validate : row.train, report.replay, k);
    table.rows.push_back(std::move(row));
  }
  return table;
}

double mean_error(RolloutModel const& model, std::vector<RolloutTrack> const& tracks, int threads) {
  RolloutTask task{tracks, {}, {true, false}};
  std::vector<std::vector<RolloutTrial>> trials;
  for (auto const& track : tracks) {
    task.structures.push_back(model.structure_for(model.start(), track.tick_s()));
    trials.push_back({model.trial(model.start())});
  }
  double sum = 0.0, samples = 0.0;
  for (auto const& track : residuals_of(task, trials, threads)) {
    sum += track.samples[0].cwiseAbs().sum();
    samples += static_cast<double>(track.samples[0].size());
  }
  return sum / samples;
}

// the same effects, fitted without the training recordings of each value in turn
ServoTable without_each(std::string const& quantity, ServoJob const& job, ServoQuestion const& question,
                        ServoDecision const& decision) {
  ServoTable table{quantity, {}};
  std::vector<SetEntry> const training(job.entries.begin(),
                                       job.entries.begin() + static_cast<std::ptrdiff_t>(job.training.size()));
  for (auto const& value : values_of(training, quantity)) {
    std::vector<RolloutTrack> kept, left_out;
    for (std::size_t k = 0; k < training.size(); ++k)
      (value_of(training[k], quantity) == value ? left_out : kept).push_back(job.training[k]);
    if (kept.empty() || left_out.empty()) continue;
    std::vector<RolloutTrack> const none;
    ServoQuestion const asked{
        question.regressor, question.loop, question.command, kept, none, {}, question.most_effects,
        question.numbers,   question.seed, question.threads};
    ServoRow row{value, {}, {}};
    row.train.recordings = static_cast<std::int64_t>(left_out.size());
    for (auto const& track : left_out) row.train.samples += track.samples();
    auto const error_of = [&](LoopFit const& structure) {
      return mean_error(decision.model(question, refitted(asked, decision, structure)), left_out, question.threads);
    };
    row.train.before = error_of(decision.base);
    row.train.after = decision.facts.kept.empty() ? row.train.before : error_of(decision.final);
    table.rows.push_back(std::move(row));
  }
  return table;
}

// of the command, not of a torque; and where no load is known, everything is in units of the command
void tell_unit(LoopNumber& number, std::string const& command, bool fixes_scale) {
  std::map<std::string, std::string> const of_command{{"kg m2", " s2/rad"}, {"N m s/rad", " s/rad"}, {"N m", ""}};
  if (number.name == "loop_torque_limit" || number.name == "loop_punch") {
    number.unit = command;
  } else if (number.name == "loop_motor_gain") {
    number.unit = fixes_scale ? "N m/" + command : "1";
  } else if (number.name == "loop_load_square_friction" && !fixes_scale) {
    number.unit = "1/" + command;
  } else if (auto const torque = of_command.find(number.unit); torque != of_command.end() && !fixes_scale) {
    number.unit = command + torque->second;
  }
}

void tell_units(ServoReport& report) {
  bool const fixes_scale = report.decision.fixes_scale;
  for (auto* numbers : {&report.base_numbers, &report.decision.facts.numbers})
    for (auto& number : *numbers) tell_unit(number, report.command_unit, fixes_scale);
  for (auto& move : report.decision.facts.kept)
    for (auto& number : move.numbers) tell_unit(number, report.command_unit, fixes_scale);
}

void refuse_unknown_quantities(ServoRequest const& request, std::vector<SetEntry> const& entries) {
  auto const told = told_apart_by(entries);
  for (auto const& name : request.leave_out)
    validate(std::find(told.begin(), told.end(), name) != told.end(), [&] {
      Problem problem{ExitCode::usage,
                      fmt::format("--leave-out {}: the recordings do not differ in such a quantity", name)};
      problem.help = fmt::format("they differ in {}", fmt::join(told, ", "));
      return problem;
    });
}

}  // namespace

ServoReport diagnose_servo(ServoJob const& job, ServoRequest const& request, ProgressSink const& progress) {
  refuse_unknown_quantities(request, job.entries);
  refuse_other_result(request.output);
  Stoppable const stoppable(request.stop_requested);
  ServoQuestion question = job.question(request.threads.count);
  question.progress = [&](char const* stage, std::size_t done, std::size_t total) {
    if (request.stop_requested && request.stop_requested()) throw Stopped();
    ProgressUpdate update;
    update.stage = stage;
    update.counted = "laws";
    update.runs_done = static_cast<std::int64_t>(done);
    update.runs_total = static_cast<std::int64_t>(total);
    if (progress) progress(update);
  };
  try {
    ServoReport report;
    report.name = job.experiment.name;
    report.command_unit = unit_of_command(job);
    report.decision = decide_servo(question);
    report.notes = notes_of(job);
    report.entries = job.entries;
    if (report.decision.facts.reason == LoopReason::diverges) return report;
    report.fit = servo_fit(question, report.decision);
    report.verdict = servo_verdict(report.decision.facts, report.fit);
    report.base_numbers = numbers_of_fit(question, report.decision, report.decision.base);
    tell_units(report);
    report.replay = replay_of(job, question, report.decision);
    for (std::size_t k = 0; k < job.entries.size(); ++k)
      add(job.entries[k].is_validation ? report.validate : report.train, report.replay, k);
    for (auto const& quantity : told_apart_by(job.entries)) report.tables.push_back(table_by(quantity, report));
    for (auto const& quantity : request.leave_out)
      report.left_out.push_back(without_each(quantity, job, question, report.decision));
    return report;
  } catch (Stopped const&) {
    Problem problem{ExitCode::stopped, "stopped: nothing was written"};
    problem.help = "the same command begins anew";
    throw Error(problem);
  }
}

}  // namespace torquescope
