// `torquescope run` and `merge`: every estimator of a job over the recordings, every generation into the result file.

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/effects/joint_form.hpp"
#include "engine/experiment/arm_payloads.hpp"
#include "engine/experiment/replay_of_parts.hpp"
#include "engine/experiment/rollout_objective.hpp"
#include "engine/experiment/runs/disk_room.hpp"
#include "engine/experiment/runs/last_states.hpp"
#include "engine/experiment/runs/population_stage.hpp"
#include "engine/experiment/runs/provenance_writer.hpp"
#include "engine/experiment/runs/rollout_stage.hpp"
#include "engine/experiment/runs/stage_progress.hpp"
#include "engine/experiment/runs/thinned_history.hpp"
#include "engine/experiment/search_box.hpp"
#include "engine/fit/problem/arm_accuracy.hpp"
#include "engine/store/shard_lock.hpp"
#include "engine/workflows/replay_writer.hpp"
#include "engine/workflows/results/arm_writer.hpp"
#include "engine/workflows/results/estimator_writer.hpp"
#include "engine/workflows/results/study_writer.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

namespace {

// what every estimator of one job shares
struct Study {
  Experiment::Parts const& parts;
  Attempt& attempt;
  ProgressSink const& progress;
  ResultWriter& writer;
  SquaredErrorFloor const& floor;  // of the training rows: what every gap is measured with
  std::string torque_unit;         // "N m" or "N"; "1" of an arm
  bool merges = false;             // nothing runs: segments have it all, or what there is
};

void keep_run(double gap, Eigen::VectorXd const& parameters, std::string stop_reason, std::int64_t evaluations,
              std::int64_t nonfinite, RunResults& results) {
  results.gap.push_back(gap);
  results.parameters.push_back(parameters);
  results.stop_reason.push_back(std::move(stop_reason));
  results.evaluations.push_back(evaluations);
  results.nonfinite.push_back(nonfinite);
}

double gap_to_floor(Study const& study, Eigen::VectorXd const& parameters) {
  return study.floor.gap({parameters.data(), static_cast<std::size_t>(parameters.size())});
}

// NaN where no row is left: a validation recording of an arm that stands still
std::vector<PredictionMetrics> metrics_of(RegressionData const& rows, std::vector<Eigen::VectorXd> const& parameters) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (rows.rows() > 0) return prediction_metrics(rows, parameters);
  return std::vector<PredictionMetrics>(parameters.size(), {none, none, none, none, none});
}

// of all runs in one sweep over the rows
void measure_runs(Study const& study, RunResults& results) {
  results.train = metrics_of(study.parts.train.regression, results.parameters);
  if (study.parts.validate) results.validate = metrics_of(study.parts.validate->regression, results.parameters);
  if (!study.parts.arm) return;
  // rows are divided by the noise of their joint; an error in per cent is one of the torques
  auto const in_torque = [&](RegressionData const& rows, std::vector<PredictionMetrics>& metrics) {
    auto const relerr = arm_relerr(rows, results.parameters);
    for (std::size_t run = 0; run < metrics.size(); ++run) metrics[run].relerr = relerr[run];
  };
  in_torque(study.parts.train.regression, results.train);
  if (study.parts.validate) in_torque(study.parts.validate->regression, results.validate);
}

RunResults run_lm(Study const& study, EstimatorPlan const& plan) {
  auto const& options = study.attempt.options;
  StageProgress progress(study.progress, plan.label, 1, 1);
  RolloutFit const fit = fit_by_rollouts(study.parts, *plan.lm, options.threads.count, options.stop_requested);
  if (options.stop_requested && options.stop_requested())
    throw Error(
        Problem{ExitCode::stopped, "stopped: nothing was published", {}, {}, {}, {}, "run the same command again"});
  RunResults results;
  RolloutObjective const objective(*study.parts.rollout, study.parts.box);
  keep_run(objective.fitness_of(fit.parameters), fit.parameters, fit.failed ? "diverged" : "converged", fit.evaluations,
           0, results);
  measure_rollouts(study.parts, options.threads.count, results);
  write_rollout_fit(study.writer, plan.label, fit);
  if (!fit.at_bounds.empty() && options.tell)
    options.tell("warning", fmt::format("{} ends on the bound of {}: the recordings do not say what it is", plan.label,
                                        fmt::join(fit.at_bounds, ", ")));
  if (fit.failed && options.tell)
    options.tell(
        "warning",
        plan.label + ": the simulation diverges at its start; check [loop], or give [model.given] near values");
  progress.count_evaluations(fit.evaluations);
  progress.count_run();
  return results;
}

RunResults run_closed_form(Study const& study, EstimatorPlan const& plan) {
  if (plan.lm) return run_lm(study, plan);
  StageProgress progress(study.progress, plan.label, 1, 1);
  LeastSquaresFit fit = plan.fit(study.parts.train.regression);
  if (study.parts.arm)
    if (auto const loads = payload_words(study.parts.arm->model, fit); !loads.empty())
      fit.remark += (fit.remark.empty() ? "" : "; ") + loads;
  RunResults results;
  keep_run(gap_to_floor(study, fit.parameters), fit.parameters, "closed form", 1, 0, results);
  measure_runs(study, results);
  auto const form = study.parts.arm ? std::nullopt : joint_form(*study.parts.regressor);
  write_least_squares(study.writer, plan.label, fit, form ? &*form : nullptr);
  progress.count_evaluations(1);
  progress.count_run();
  return results;
}

// of a run that no segment has
RunHistory missing_history(HistoryShape const& shape) {
  RunHistory history;
  history.pad(shape.generations + 1, shape.members, shape.parameters);
  history.parameters.assign(shape.parameters, std::numeric_limits<double>::quiet_NaN());
  history.stop_reason = missing_run;
  return history;
}

std::span<double const> history_of(StoredRuns const& runs, std::vector<double> RunHistory::*values) {
  for (std::size_t i = 0; i < history_lists.size(); ++i)
    if (history_lists[i].values == values) return runs.histories[i].values;
  return {};
}

// whose histories are some blocks of a result: fewer cost more calls, more cost memory
std::size_t runs_at_once(HistoryShape const& shape) {
  constexpr std::size_t bytes = std::size_t{512} << 10;
  std::size_t const bytes_of_run = (shape.generations + 1) * shape.members * shape.parameters * sizeof(double);
  return std::clamp<std::size_t>(bytes / std::max<std::size_t>(1, bytes_of_run), 1, 1000);
}

RunResults run_population_method(Study const& study, EstimatorPlan const& plan) {
  auto const& parts = study.parts;
  auto const choice = fitness_choice(parts, plan);
  HistoryShape const shape = history_shape(parts, plan);
  StoredGenerations const stored_ones = stored_generations(parts, plan);
  declare_histories(study.writer, plan.label, shape, stored_ones, study.torque_unit);
  RunResults results;
  LastStates last_states;
  std::vector<std::int64_t> last_generations;
  std::vector<double> PC, FC;  // of estimators with a controller
  auto const keep = [&](std::span<double const> best, double last_gap, std::string const& reason,
                        std::int64_t evaluations, std::int64_t nonfinite) {
    Eigen::VectorXd const parameters =
        Eigen::Map<Eigen::VectorXd const>(best.data(), static_cast<Eigen::Index>(shape.parameters));
    keep_run(plan.rolls_out() ? last_gap : gap_to_floor(study, parameters), parameters, reason, evaluations, nonfinite,
             results);
  };
  auto const commit = [&](std::size_t run, std::shared_ptr<RunHistory const> const& history) {
    auto const kept =
        stored_ones.all() ? history : std::make_shared<RunHistory const>(thinned(*history, shape, stored_ones));
    write_history(study.writer, plan.label, run, kept);
    last_generations.push_back(static_cast<std::int64_t>(history->told) - 1);
    // behind the end of a run that stopped early stands padding
    double const last_gap = history->told > 0 ? history->gap[history->told - 1] : history->gap.back();
    keep(history->parameters, last_gap, history->stop_reason, history->evaluations.back(), history->nonfinite);
    if (stored_ones.all()) last_states.add(history->last_state);
    if (!plan.controller) return;
    PC.insert(PC.end(), kept->PC.begin(), kept->PC.end());
    FC.insert(FC.end(), kept->FC.begin(), kept->FC.end());
  };
  auto const commit_stored = [&](std::size_t first, StoredRuns const& runs) {
    StoredRuns const some = stored_ones.all() ? StoredRuns() : thinned(runs, shape, stored_ones);
    StoredRuns const& kept = stored_ones.all() ? runs : some;
    write_histories(study.writer, plan.label, first, kept);
    last_generations.insert(last_generations.end(), runs.count, static_cast<std::int64_t>(shape.generations));
    std::size_t const entries = shape.generations + 1;
    auto const gaps = history_of(runs, &RunHistory::gap);
    for (std::size_t i = 0; i < runs.count; ++i) {
      std::size_t const last = (i + 1) * entries - 1;
      keep(runs.parameters.values.subspan(i * shape.parameters, shape.parameters), gaps[last], runs.stop_reasons[i],
           runs.evaluations.values[last], runs.nonfinite.values[i]);
      if (stored_ones.all()) last_states.add(runs.last_states[i]);
    }
    if (!plan.controller) return;
    for (auto const& [all, list] : {std::pair{&PC, &RunHistory::PC}, {&FC, &RunHistory::FC}}) {
      auto const values = history_of(kept, list);
      all->insert(all->end(), values.begin(), values.end());
    }
  };
  if (!study.merges) {
    run_population({parts, plan, choice, study.floor, study.progress, study.attempt}, runs_of_shard(parts, {}), commit);
  } else {
    StageProgress progress(study.progress, plan.label, parts.experiment.runs, 0);
    for (std::size_t run = 0; run < shape.runs;) {
      if (auto const stored = study.attempt.saved.load_stored(plan.label, shape, run, runs_at_once(shape))) {
        commit_stored(run, *stored);
        for (std::size_t i = 0; i < stored->count; ++i) progress.count_run();
        run += stored->count;
        continue;
      }
      auto part = study.attempt.saved.load(plan.label, shape, run);
      bool const is_there = part && part->ended;
      commit(run, std::make_shared<RunHistory const>(is_there ? std::move(part->history) : missing_history(shape)));
      progress.count_run();
      ++run;
    }
  }
  if (plan.rolls_out())
    measure_rollouts(parts, study.attempt.options.threads.count, results);
  else
    measure_runs(study, results);
  // nothing goes on from a history with gaps
  if (!stored_ones.all())
    write_ends(study.writer, plan.label, last_generations);
  else if (shape.members > 0)
    last_states.write(study.writer, plan.label);
  write_fitness_choice(study.writer, plan.label, choice);
  if (plan.controller) write_controller(study.writer, plan.label, *plan.controller, shape.runs, PC, FC);
  return results;
}

void tell(IdentifyOptions const& options, std::string const& topic, std::string const& text) {
  if (options.tell) options.tell(topic, text);
}

// a best that lies on the box is where the box ends, not where the data say
void warn_of_bounds(Study const& study, EstimatorPlan const& plan, RunResults const& results) {
  auto const present = results.present();
  if (present.empty()) return;
  auto const best = *std::min_element(present.begin(), present.end(),
                                      [&](std::size_t a, std::size_t b) { return results.gap[a] < results.gap[b]; });
  auto const names = on_bounds(study.parts.parameter_names(), study.parts.box, results.parameters[best]);
  if (names.empty()) return;
  tell(study.attempt.options, "warning",
       fmt::format("{} ends on the bound of {}: the best may lie outside; widen [model.bounds]", plan.label,
                   fmt::join(names, ", ")));
}

// the result stands: what it was made of is no longer wanted
void tidy_up(IdentifyOptions const& options, std::string const& inputs_sha256) {
  for (auto const& warning : remove_segments(options.output, inputs_sha256)) tell(options, "warning", warning);
}

void tell_what_was_done(Attempt const& attempt) {
  for (auto const& warning : attempt.saved.warnings()) tell(attempt.options, "warning", warning);
  if (attempt.saved.mixed())
    tell(attempt.options, "warning", "segments of another program or job are taken: --allow-mixed");
  if (!attempt.saved.empty())
    tell(attempt.options, "resume",
         fmt::format("{}: {} of {} runs were done", attempt.options.output.filename().string(), attempt.runs_before,
                     attempt.runs_total));
  for (auto const& line : attempt.earlier.lines()) tell(attempt.options, "continue", line);
}

// from an attempt that has, or makes, every run
IdentifyReport write_result(Experiment experiment, Attempt& attempt, bool merges, ProgressSink const& progress) {
  Beginning const beginning;
  auto const& options = attempt.options;
  auto const& parts = experiment.parts();
  ResultWriter writer(options.output, {.gzip = parts.output.compression == "gzip",
                                       .expected_bytes = result_bytes(parts),
                                       .inputs_sha256 = experiment.inputs_sha256()});
  write_study(writer, experiment);
  experiment.forget_motion();

  SquaredErrorFloor const floor(parts.train.regression, parts.reductions);
  experiment.forget_reductions();
  Study const study{parts, attempt, progress, writer, floor, parts.torque_unit(), merges};
  IdentifyReport report;
  std::vector<std::string> order;
  std::vector<ReplaySource> rolled;
  for (auto const& plan : parts.estimators) {
    RunResults const results =
        plan.is_closed_form() ? run_closed_form(study, plan) : run_population_method(study, plan);
    write_results(writer, plan, results, plan.rolls_out() ? rollout_error_unit(parts) : study.torque_unit,
                  parts.parameter_names());
    if (parts.regressor && parts.parameters() == parts.row_parameters())
      write_model_code(writer, plan.label, *parts.regressor, parts.torque_unit(), results);
    if (parts.arm) write_arm_accuracy(writer, plan.label, parts, results);
    if (!plan.is_closed_form()) warn_of_bounds(study, plan, results);
    if (plan.rolls_out()) write_rollout_errors(writer, plan.label, parts);
    if (plan.rolls_out() && !results.present().empty()) {
      Eigen::VectorXd const& typical = results.parameters[lower_median_index(results.gap)];
      add_source_of_run(parts, *parts.rollout, plan.label, parts.parameter_names(), {typical.begin(), typical.end()},
                        rolled);
    }
    order.push_back(plan.label);
    report.runs += static_cast<std::int64_t>(results.runs());
    for (std::int64_t evaluations : results.evaluations) report.evaluations += evaluations;
  }
  writer.attribute("/runs", "order", order);
  if (parts.rollout && !rolled.empty())
    write_replay(writer, replay_of(parts, *parts.rollout, rolled, options.threads.count));
  // whoever asks to stop now is served best by the result
  if (options.saving) options.saving();
  report.content_sha256 = finish_result(writer, options.output, options.threads, beginning,
                                        {attempt.saved.origins(), attempt.earlier.content_sha256()});
  report.seconds = beginning.seconds();
  report.bytes = std::filesystem::file_size(options.output);
  report.result = writer.take_written();
  return report;
}

}  // namespace

IdentifyReport identify(Experiment experiment, IdentifyOptions const& options, ProgressSink const& progress) {
  IdentifyReport report;
  std::string const inputs = experiment.inputs_sha256();
  {
    ShardLock const lock(options.output, {});
    Attempt attempt(experiment, options, LeftSegments::are_gathered);
    tell_what_was_done(attempt);
    check_room(options, result_bytes(experiment.parts()), options.output);
    try {
      report = write_result(std::move(experiment), attempt, false, progress);
    } catch (Error const& error) {
      if (error.code() != ExitCode::stopped) throw;
      stop_and_save(attempt);
    }
  }
  tidy_up(options, inputs);
  return report;
}

IdentifyReport merge(Experiment experiment, IdentifyOptions const& options, Completeness wanted,
                     ProgressSink const& progress) {
  Attempt attempt(experiment, options, LeftSegments::stay);
  tell_what_was_done(attempt);
  std::size_t count = 0;
  std::string const missing = missing_runs(experiment.parts(), attempt.saved, count);
  if (count > 0 && wanted == Completeness::whole) {
    Problem problem;
    problem.code = ExitCode::stopped;
    problem.what = fmt::format("{} of {} runs are missing: nothing was merged", count, attempt.runs_total);
    problem.notes = {missing};
    if (auto const shards = words_of_missing_shards(experiment.parts(), attempt.saved); !shards.empty())
      problem.notes.push_back(shards);
    problem.help = "run their shards again, or `torquescope run` the job to do all that is missing; or --partial";
    throw Error(problem);
  }
  if (count > 0)
    tell(options, "warning", fmt::format("{} of {} runs are missing: {}", count, attempt.runs_total, missing));
  check_room(options, result_bytes(experiment.parts()), options.output);
  std::string const inputs = experiment.inputs_sha256();
  IdentifyReport report = write_result(std::move(experiment), attempt, true, progress);
  // of a part of the runs, the segments are still wanted
  if (count == 0) tidy_up(options, inputs);
  return report;
}

}  // namespace torquescope
