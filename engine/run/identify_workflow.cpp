// `torquescope run`: every estimator of a job over the recordings, every generation into the result file.

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>

#include "engine/effects/joint_form.hpp"
#include "engine/problem/residual_objective.hpp"
#include "engine/problem/squared_error_floor.hpp"
#include "engine/problem/statistics_objective.hpp"
#include "engine/run/estimator_writer.hpp"
#include "engine/run/experiment_parts.hpp"
#include "engine/run/optimise.hpp"
#include "engine/run/provenance_writer.hpp"
#include "engine/run/run_scheduler.hpp"
#include "engine/run/study_writer.hpp"

namespace torquescope {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// tells the sink at most once per finished run and some times a second between
class StageProgress {
 public:
  StageProgress(ProgressSink const& sink, std::string stage, std::int64_t runs, std::int64_t evaluations)
      : sink_(sink), start_(Clock::now()) {
    update_.stage = std::move(stage);
    update_.runs_total = runs;
    update_.evaluations_total = evaluations;
    tell();
  }

  void count_evaluations(std::int64_t evaluations) {
    evaluations_.fetch_add(evaluations, std::memory_order_relaxed);
    // a thread that finds the sink busy leaves the news to the next one
    std::unique_lock const lock(guard_, std::try_to_lock);
    if (lock.owns_lock() && seconds_since(last_) > 0.05) tell();
  }

  void count_run() {
    std::lock_guard const lock(guard_);
    ++update_.runs_done;
    tell();
  }

 private:
  void tell() {
    last_ = Clock::now();
    update_.evaluations_done = evaluations_.load(std::memory_order_relaxed);
    update_.seconds = seconds_since(start_);
    if (sink_) sink_(update_);
  }

  ProgressSink const& sink_;
  Clock::time_point start_;
  Clock::time_point last_{};
  std::mutex guard_;
  std::atomic<std::int64_t> evaluations_{0};
  ProgressUpdate update_;
};

// what every estimator of one job shares
struct Study {
  Experiment::Parts const& parts;
  IdentifyOptions const& options;
  ProgressSink const& progress;
  ResultWriter& writer;
  SquaredErrorFloor const& floor;  // of the training rows: what every gap is measured with
  std::string torque_unit;         // "N m" or "N"
};

void keep_run(Study const& study, Eigen::VectorXd const& parameters, std::string stop_reason, std::int64_t evaluations,
              std::int64_t nonfinite, RunResults& results) {
  results.gap.push_back(study.floor.gap({parameters.data(), static_cast<std::size_t>(parameters.size())}));
  results.train.push_back(prediction_metrics(study.parts.train.regression, parameters));
  if (study.parts.validate)
    results.validate.push_back(prediction_metrics(study.parts.validate->regression, parameters));
  results.parameters.push_back(parameters);
  results.stop_reason.push_back(std::move(stop_reason));
  results.evaluations.push_back(evaluations);
  results.nonfinite.push_back(nonfinite);
}

RunResults run_closed_form(Study const& study, EstimatorPlan const& plan) {
  StageProgress progress(study.progress, plan.label, 1, 1);
  LeastSquaresFit const fit = plan.fit(study.parts.train.regression);
  RunResults results;
  keep_run(study, fit.parameters, "closed form", 1, 0, results);
  auto const form = joint_form(*study.parts.regressor);
  write_least_squares(study.writer, plan.label, fit, form ? &*form : nullptr);
  progress.count_evaluations(1);
  progress.count_run();
  return results;
}

std::unique_ptr<Objective> make_objective(Experiment::Parts const& parts, EstimatorPlan const& plan,
                                          FitnessChoice const& choice) {
  auto const& rows = parts.train.regression;
  auto const scale = fitness_scale(plan.objective);
  if (choice.from_statistics)
    return std::make_unique<StatisticsObjective>(*parts.statistics, static_cast<std::size_t>(rows.rows()), parts.box,
                                                 scale);
  if (choice.in_float32) return std::make_unique<SinglePrecisionObjective>(rows, parts.box, scale);
  return std::make_unique<ResidualObjective>(rows, parts.box, make_loss(plan.objective, rows), scale);
}

RunResults run_population_method(Study const& study, EstimatorPlan const& plan) {
  auto const& parts = study.parts;
  auto const choice = fitness_choice(parts, plan);
  auto const objective = make_objective(parts, plan, choice);
  HistoryShape const shape{static_cast<std::size_t>(parts.experiment.runs),
                           static_cast<std::size_t>(plan.stop_rules.generations),
                           plan.make_optimiser(parts.box, {})->batch_size(), parts.regressor->size()};
  declare_histories(study.writer, plan.label, shape, study.torque_unit);
  StageProgress progress(study.progress, plan.label, parts.experiment.runs,
                         static_cast<std::int64_t>(shape.runs * (shape.generations + 1) * shape.members));

  SearchSetting const setting{
      *objective,
      plan.stop_rules,
      fitness_scale(plan.objective) == FitnessScale::mse ? 1.0
                                                         : 1.0 / static_cast<double>(parts.train.regression.rows()),
      [&](std::span<double const> candidate) { return study.floor.gap(candidate); },
      [&](std::int64_t evaluations) { progress.count_evaluations(evaluations); },
      study.options.stop_requested,
  };
  auto const run = [&](std::size_t first, std::size_t count, int team) {
    std::vector<std::unique_ptr<Optimiser>> searches;
    for (std::size_t index = first; index < first + count; ++index) {
      RandomKey const key{static_cast<std::uint64_t>(parts.experiment.seed), static_cast<std::uint32_t>(index)};
      searches.push_back(plan.make_optimiser(parts.box, key));
    }
    std::vector<Workspace> workspaces;
    return optimise(searches, setting, team, workspaces);
  };
  RunResults results;
  std::vector<double> PC, FC;
  auto const commit = [&](std::size_t index, RunHistory&& history) {
    write_history(study.writer, plan.label, index, history);
    Eigen::VectorXd const parameters =
        Eigen::Map<Eigen::VectorXd const>(history.parameters.data(), static_cast<Eigen::Index>(shape.parameters));
    keep_run(study, parameters, history.stop_reason, history.evaluations.back(), history.nonfinite, results);
    PC.insert(PC.end(), history.PC.begin(), history.PC.end());
    FC.insert(FC.end(), history.FC.begin(), history.FC.end());
    progress.count_run();
  };
  schedule_runs(shape.runs, study.options.threads.count, runs_side_by_side(*objective, plan.stop_rules, shape.members),
                run, commit);
  write_fitness_choice(study.writer, plan.label, choice);
  if (plan.controller) write_controller(study.writer, plan.label, *plan.controller, shape, PC, FC);
  return results;
}

}  // namespace

IdentifyReport identify(Experiment const& experiment, IdentifyOptions const& options, ProgressSink const& progress) {
  auto const start = Clock::now();
  std::string const started = utc_now();
  auto const& parts = experiment.parts();
  ResultWriter writer(options.output, {.gzip = parts.output.compression == "gzip"});
  write_study(writer, experiment);

  SquaredErrorFloor const floor(parts.train.regression);
  bool const revolute = parts.regressor->joint() == JointKind::revolute;
  Study const study{parts, options, progress, writer, floor, revolute ? "N m" : "N"};
  IdentifyReport report;
  std::vector<std::string> order;
  for (auto const& plan : parts.estimators) {
    RunResults const results =
        plan.is_closed_form() ? run_closed_form(study, plan) : run_population_method(study, plan);
    write_results(writer, plan, results, study.torque_unit);
    order.push_back(plan.label);
    report.runs += static_cast<std::int64_t>(results.runs());
    for (std::int64_t evaluations : results.evaluations) report.evaluations += evaluations;
  }
  writer.attribute("/runs", "order", order);
  report.seconds = seconds_since(start);
  write_provenance(writer, options.threads, started, report.seconds);
  report.content_sha256 = writer.finish();
  report.bytes = std::filesystem::file_size(options.output);
  return report;
}

}  // namespace torquescope
