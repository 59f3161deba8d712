#include "engine/experiment/runs/population_stage.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/experiment/rollout_objective.hpp"
#include "engine/experiment/runs/code_identity.hpp"
#include "engine/experiment/runs/optimise.hpp"
#include "engine/experiment/runs/provenance_writer.hpp"
#include "engine/experiment/runs/run_scheduler.hpp"
#include "engine/experiment/runs/search_identity.hpp"
#include "engine/experiment/runs/stage_progress.hpp"
#include "engine/fit/problem/residual_objective.hpp"
#include "engine/fit/problem/statistics_objective.hpp"

namespace torquescope {

namespace {

using History = std::shared_ptr<RunHistory const>;

std::unique_ptr<Objective> make_objective(Experiment::Parts const& parts, EstimatorPlan const& plan,
                                          FitnessChoice const& choice) {
  if (choice.by_rollouts) return std::make_unique<RolloutObjective>(*parts.rollout, parts.box);
  auto const& rows = parts.train.regression;
  auto const scale = fitness_scale(plan.objective);
  if (choice.from_statistics)
    return std::make_unique<StatisticsObjective>(*parts.statistics, static_cast<std::size_t>(rows.rows()), parts.box,
                                                 scale);
  if (choice.in_float32) return std::make_unique<SinglePrecisionObjective>(rows, parts.box, scale);
  return std::make_unique<ResidualObjective>(rows, parts.box, make_loss(plan.objective, rows), scale);
}

double fitness_of(Objective const& objective, std::span<double const> candidate) {
  double fitness = 0.0;
  Workspace workspace;
  objective.evaluate({candidate.data(), 1, candidate.size()}, {&fitness, 1}, workspace);
  return fitness;
}

SegmentOrigin origin_of(Experiment const& experiment, IdentifyOptions const& options) {
  SegmentOrigin origin;
  origin.job_sha256 = experiment.parts().job.sha256;
  origin.inputs_sha256 = experiment.inputs_sha256();
  origin.numerics_sha256 = numerics_sha256();
  origin.job_name = experiment.name();
  origin.shard_index = options.shard.index;
  origin.shard_count = options.shard.count;
  origin.pid = ::getpid();
  origin.threads = options.threads.count;
  origin.started = utc_now();
  return origin;
}

SavedRuns find_saved_runs(Experiment const& experiment, IdentifyOptions const& options) {
  SavedRunsRequest request;
  request.own_folder = segment_folder_of(options.output);
  request.more_folders = options.more_segments;
  request.expected = origin_of(experiment, options);
  for (auto const& plan : experiment.parts().estimators)
    if (!plan.is_closed_form()) request.searches[plan.label] = search_sha256(experiment.parts(), plan);
  request.allow_mixed = options.allow_mixed;
  if (options.shard.count > 1) {
    auto const runs = static_cast<std::size_t>(experiment.parts().experiment.runs);
    request.wanted = [first = options.shard.first(runs), end = options.shard.end(runs)](std::size_t run) {
      return run >= first && run < end;
    };
  }
  return SavedRuns(request);
}

// ten thousand small ones take most of a minute to open, each time
bool gather_left_segments_of(SavedRuns const& saved, IdentifyOptions const& options) {
  auto const folder = segment_folder_of(options.output);
  std::vector<LeftSegment> left;
  for (std::size_t i = 0; i < saved.files().size(); ++i) {
    auto const& origin = saved.origins()[i];
    bool const is_of_this_share =
        origin.shard_index == options.shard.index && origin.shard_count == options.shard.count;
    if (is_of_this_share && saved.files()[i].path.parent_path() == folder)
      left.push_back({saved.files()[i].path, origin});
  }
  return gather_left_segments(left, SegmentNames(folder, options.shard), RunKeeper::Setting{}.most_bytes);
}

SavedRuns saved_runs_of(Experiment const& experiment, IdentifyOptions const& options, LeftSegments left) {
  SavedRuns saved = find_saved_runs(experiment, options);
  bool const are_fewer = left == LeftSegments::are_gathered && gather_left_segments_of(saved, options);
  return are_fewer ? find_saved_runs(experiment, options) : std::move(saved);
}

// a new optimiser, or one that goes on from a part
RunStart make_start(PopulationStage const& stage, std::size_t run, std::optional<RunPart> part) {
  RandomKey const key{static_cast<std::uint64_t>(stage.parts.experiment.seed), static_cast<std::uint32_t>(run)};
  RunStart start{stage.plan.make_optimiser(stage.parts.box, key)};
  if (!part) return start;
  try {
    start.search->restore(part->state);
  } catch (std::invalid_argument const& refusal) {
    auto const& options = stage.attempt.options;
    throw Error(Problem{.code = ExitCode::bad_job,
                        .what = fmt::format("run {} of {} cannot go on: {}", run, stage.plan.label, refusal.what()),
                        .help = fmt::format("delete {}{} to begin again", segment_folder_of(options.output).string(),
                                            options.continued.empty() ? "" : " and leave out --continue")});
  }
  start.history = std::move(part->history);
  return start;
}

// one group of neighbouring runs
class Group {
 public:
  Group(PopulationStage const& stage, HistoryShape const& shape, SearchSetting setting)
      : stage_(stage), shape_(shape), setting_(std::move(setting)) {
    auto& keeper = stage_.attempt.keeper;
    setting_.keep_now = [&keeper, seen = keeper.due()]() mutable {
      auto const due = keeper.due();
      return due != std::exchange(seen, due);
    };
    setting_.keep = [this](std::size_t index, RunSoFar const& so_far) {
      stage_.attempt.keeper.keep(begun_[index], so_far);
    };
  }

  std::vector<History> run(std::span<std::size_t const> runs, int team) {
    std::vector<History> histories(runs.size());
    std::vector<RunStart> starts;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      auto part = load(runs[i]);
      if (part && part->ended) {
        histories[i] = std::make_shared<RunHistory const>(std::move(part->history));
        continue;
      }
      starts.push_back(make_start(stage_, runs[i], std::move(part)));
      places.push_back(i);
      begun_.push_back(runs[i]);
      stage_.attempt.keeper.begin(runs[i]);
    }
    if (starts.empty()) return histories;
    std::vector<Workspace> workspaces;
    auto found = optimise(std::move(starts), setting_, team, workspaces);
    for (std::size_t k = 0; k < found.size(); ++k) {
      auto const history = std::make_shared<RunHistory const>(std::move(found[k]));
      histories[places[k]] = history;
      stage_.attempt.keeper.ended(begun_[k], history);
    }
    return histories;
  }

 private:
  // of segments and the earlier result, whichever has more
  std::optional<RunPart> load(std::size_t run) {
    auto& saved = stage_.attempt.saved;
    auto const& earlier = stage_.attempt.earlier;
    if (saved.empty() && earlier.empty()) return std::nullopt;
    std::lock_guard const alone(stage_.attempt.hdf5);
    auto part = saved.empty() ? std::nullopt : saved.load(stage_.plan.label, shape_, run);
    if (part && part->ended) return part;
    auto before = earlier.load(stage_.plan.label, shape_, run);
    return before && (!part || before->count > part->count) ? std::move(before) : std::move(part);
  }

  PopulationStage const& stage_;
  HistoryShape const& shape_;
  SearchSetting setting_;
  std::vector<std::size_t> begun_;
};

}  // namespace

Attempt::Attempt(Experiment const& experiment, IdentifyOptions const& given, LeftSegments left)
    : options(given),
      saved(saved_runs_of(experiment, given, left)),
      earlier(given.continued.empty() ? EarlierResult()
                                      : EarlierResult(given.continued, experiment.parts(), given.allow_mixed)),
      keeper({.folder = segment_folder_of(given.output),
              .origin = origin_of(experiment, given),
              .shard = given.shard,
              .interval_s = given.segment_seconds,
              .everything = given.shard.count > 1,
              .safe =
                  [this](std::size_t runs) {
                    if (options.safe) options.safe(runs_before + runs, runs_total);
                  }},
             hdf5) {
  auto const runs = runs_of_shard(experiment.parts(), options.shard);
  for (auto const& plan : experiment.parts().estimators) {
    if (plan.is_closed_form()) continue;
    ++methods;
    runs_total += runs.size();
    runs_before += static_cast<std::size_t>(
        std::count_if(runs.begin(), runs.end(), [&](std::size_t run) { return saved.has_ended(plan.label, run); }));
  }
}

HistoryShape history_shape(Experiment::Parts const& parts, EstimatorPlan const& plan) {
  return {static_cast<std::size_t>(parts.experiment.runs), static_cast<std::size_t>(plan.stop_rules.generations),
          parts.output.populations ? plan.make_optimiser(parts.box, {})->largest_batch() : 0, parts.parameters()};
}

StoredGenerations stored_generations(Experiment::Parts const& parts, EstimatorPlan const& plan) {
  return StoredGenerations::of(parts.output.history, static_cast<std::size_t>(plan.stop_rules.generations)).value();
}

std::vector<std::size_t> runs_of_shard(Experiment::Parts const& parts, ShardChoice const& shard) {
  std::vector<std::size_t> runs;
  auto const n_runs = static_cast<std::size_t>(parts.experiment.runs);
  for (std::size_t run = shard.first(n_runs); run < shard.end(n_runs); ++run) runs.push_back(run);
  return runs;
}

void run_population(PopulationStage const& stage, std::vector<std::size_t> const& runs, CommitRun const& commit) {
  auto const& [parts, plan, choice, floor, sink, attempt] = stage;
  HistoryShape const shape = history_shape(parts, plan);
  std::size_t const batch = plan.make_optimiser(parts.box, {})->largest_batch();
  auto const objective = make_objective(parts, plan, choice);
  std::map<std::size_t, std::size_t> safe;
  for (std::size_t const run : runs)
    if (auto const generations = attempt.saved.generations(plan.label, run)) safe[run] = generations;
  attempt.keeper.begin_estimator(plan.label, search_sha256(parts, plan), shape, safe);

  StageProgress progress(sink, plan.label, static_cast<std::int64_t>(runs.size()),
                         static_cast<std::int64_t>(runs.size() * (shape.generations + 1) * batch));
  SearchSetting const setting{
      *objective,
      plan.stop_rules,
      fitness_scale(plan.objective) == FitnessScale::mse || choice.by_rollouts
          ? 1.0
          : 1.0 / static_cast<double>(parts.train.regression.rows()),
      // of rollouts nobody knows the floor: a gap is the fitness itself
      [&](std::span<double const> candidate) {
        return stage.choice.by_rollouts ? fitness_of(*objective, candidate) : stage.floor.gap(candidate);
      },
      [&](std::int64_t evaluations) { progress.count_evaluations(evaluations); },
      attempt.options.stop_requested,
      parts.output.populations,
  };
  schedule_runs(
      runs.size(), attempt.options.threads.count, runs_side_by_side(*objective, plan.stop_rules, batch),
      [&](std::size_t first, std::size_t count, int team) {
        return Group(stage, shape, setting).run(std::span(runs).subspan(first, count), team);
      },
      [&](std::size_t index, History const& history) {
        {
          std::lock_guard const alone(stage.attempt.hdf5);
          commit(runs[index], history);
        }
        progress.count_run();
      });
}

void stop_and_save(Attempt& attempt) {
  auto const& options = attempt.options;
  if (options.saving) options.saving();
  attempt.keeper.write_all();
  std::size_t const safe = attempt.runs_before + attempt.keeper.runs_safe();
  Problem problem;
  problem.code = ExitCode::stopped;
  problem.what = fmt::format("stopped by {}: {} of {} runs are safe",
                             options.stop_words ? options.stop_words() : "request", safe, attempt.runs_total);
  if (attempt.keeper.segments_written() > 0 || attempt.runs_before > 0)
    problem.notes = {"and so is what others had begun, in " + segment_folder_of(options.output).string()};
  problem.help = "run the same command again to continue";
  throw Error(problem);
}

std::string words_of_missing_shards(Experiment::Parts const& parts, SavedRuns const& saved) {
  auto const& origins = saved.origins();
  if (origins.empty() || origins.front().shard_count < 2) return "";
  std::size_t const shards = origins.front().shard_count;
  auto const is_of_them = [&](SegmentOrigin const& origin) { return origin.shard_count == shards; };
  if (!std::all_of(origins.begin(), origins.end(), is_of_them)) return "";
  auto const has_ended = [&](std::size_t run) {
    return std::all_of(parts.estimators.begin(), parts.estimators.end(), [&](EstimatorPlan const& plan) {
      return plan.is_closed_form() || saved.has_ended(plan.label, run);
    });
  };
  auto missing = unfinished_shares(static_cast<std::size_t>(parts.experiment.runs), shards, has_ended);
  constexpr std::size_t most_shards = 12;
  bool const cut = missing.size() > most_shards;
  if (cut) missing.resize(most_shards);
  return fmt::format("they are of shards {}{} of {}: torquescope run JOB.toml --shard {}/{}", fmt::join(missing, ", "),
                     cut ? ", ..." : "", shards, missing.front(), shards);
}

std::string missing_runs(Experiment::Parts const& parts, SavedRuns const& saved, std::size_t& count) {
  std::vector<std::string> words;
  count = 0;
  for (auto const& plan : parts.estimators) {
    if (plan.is_closed_form()) continue;
    std::vector<std::string> ranges;
    auto const runs = static_cast<std::size_t>(parts.experiment.runs);
    for (std::size_t run = 0; run < runs; ++run) {
      if (saved.has_ended(plan.label, run)) continue;
      std::size_t const first = run;
      while (run + 1 < runs && !saved.has_ended(plan.label, run + 1)) ++run;
      count += run - first + 1;
      ranges.push_back(first == run ? fmt::format("{}", first) : fmt::format("{} to {}", first, run));
    }
    constexpr std::size_t most_ranges = 12;
    bool const cut = ranges.size() > most_ranges;
    if (cut) ranges.resize(most_ranges);
    if (!ranges.empty())
      words.push_back(fmt::format("{} {}{}", plan.label, fmt::join(ranges, ", "), cut ? ", ..." : ""));
  }
  return fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace torquescope
