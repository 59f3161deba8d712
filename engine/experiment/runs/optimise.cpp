#include "engine/experiment/runs/optimise.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/parallel.hpp"
#include "engine/fit/optim/optimiser_state.hpp"

namespace torquescope {

namespace {

// candidates of one task when a team splits a batch: two register groups of the kernel
constexpr std::size_t team_block = 12;

// Up to this size a recording waits for 30 candidates in a cache that is fast enough. Measured on a Xeon with 2 MB of
// L2 per core (bench_seed_search, 4 runs side by side against 1, CPU time, fastest of 4 or 5): no gain at 0.4 to 4 MB
// for R = 4, 4 % at 5 MB for R = 60, 14 % at 49 MB for R = 60; from memory 3, 12 and 15 % for R = 4, 24, 60.
constexpr std::size_t cached_bytes = std::size_t{4} << 20;
// Candidates of a sweep that waits for arithmetic, not for memory: 240 gained at most 2 % over 120.
constexpr std::size_t candidates_per_sweep = 120;

void evaluate(Objective const& objective, MatrixView<double const> candidates, std::span<double> fitness, int team,
              std::vector<Workspace>& workspaces) {
  if (team <= 1 || candidates.rows() <= team_block) {
    objective.evaluate(candidates, fitness, workspaces.front());
    return;
  }
  std::size_t const blocks = (candidates.rows() + team_block - 1) / team_block;
  parallel_for(blocks, team, [&](std::size_t block, int thread) {
    std::size_t const first = block * team_block;
    std::size_t const count = std::min(team_block, candidates.rows() - first);
    objective.evaluate(candidates.rows(first, count), fitness.subspan(first, count),
                       workspaces[static_cast<std::size_t>(thread)]);
  });
}

// rows of a population in a history
std::size_t stored_members(Optimiser const& optimiser, SearchSetting const& setting) {
  return setting.keeps_populations ? optimiser.largest_batch() : 0;
}

void record_population(Optimiser const& optimiser, RunHistory& history) {
  auto const population = optimiser.population();
  history.population.insert(history.population.end(), population.data(),
                            population.data() + population.rows() * population.columns());
  auto const fitness = optimiser.fitness();
  history.fitness.insert(history.fitness.end(), fitness.begin(), fitness.end());
  history.pad_population(optimiser.largest_batch() - population.rows(), population.columns());
}

void record(Optimiser const& optimiser, SearchSetting const& setting, RunHistory& history) {
  Progress const& progress = optimiser.progress();
  if (setting.keeps_populations) record_population(optimiser, history);
  history.F.push_back(progress.F);
  history.CR.push_back(progress.CR);
  history.PC.push_back(progress.PC);
  history.FC.push_back(progress.FC);
  history.best.push_back(progress.best_fitness * setting.fitness_to_mse);
  // the same member has the same gap
  bool const improved = progress.last_improvement == progress.generation;
  history.gap.push_back(improved ? setting.gap_to_floor(progress.best) : history.gap.back());
  history.evaluations.push_back(progress.evaluations);
}

// every history of an estimator has this size in the end; the initial population is one of them
std::size_t stored_generations(StopRules const& rules) { return static_cast<std::size_t>(rules.generations) + 1; }

// one of the searches that go side by side
struct Run {
  Optimiser& search;
  RunHistory history{};
  double spent_before_s = 0.0;
  std::size_t first = 0, rows = 0;  // its part of the present sweep
  // of its last batch only the first rows were told; with a larger budget it would have been whole, so nothing goes on
  // behind it, but from the state before it (none of the first batch)
  bool is_cut = false;
  OptimiserState before_cut{};
  std::optional<StopReason> reason{};

  RunSoFar so_far() const {
    return {history, history.best.size() - (is_cut ? 1 : 0), [this] { return is_cut ? before_cut : search.save(); }};
  }
};

void remember_state_before_cut(Run& run) {
  run.is_cut = run.rows < run.search.batch_size();
  if (run.is_cut && !run.history.best.empty()) run.before_cut = run.search.save();
}

RunHistory finished(Run& run, SearchSetting const& setting) {
  if (setting.keeps_populations) run.history.last_state = without_population(run.so_far().state());
  run.history.told = run.history.best.size();
  run.history.pad(stored_generations(setting.rules), stored_members(run.search, setting), run.search.dimension());
  run.history.parameters = run.search.progress().best;
  run.history.stop_reason = to_string(*run.reason);
  run.history.nonfinite = run.search.progress().nonfinite;
  return std::move(run.history);
}

// runs that ended stay in their group until all of it has: kept here, they are not searched again
void keep(std::vector<Run>& runs, SearchSetting const& setting) {
  for (std::size_t index = 0; index < runs.size(); ++index) setting.keep(index, runs[index].so_far());
}

void stop_if_requested(std::vector<Run>& runs, SearchSetting const& setting) {
  if (!setting.stop_requested || !setting.stop_requested()) return;
  if (setting.keep) keep(runs, setting);
  throw Error(
      Problem{ExitCode::stopped, "stopped: nothing was published", {}, {}, {}, {}, "run the same command again"});
}

}  // namespace

std::vector<RunHistory> optimise(std::vector<RunStart> starts, SearchSetting const& setting, int team,
                                 std::vector<Workspace>& workspaces) {
  using Clock = std::chrono::steady_clock;
  auto const start = Clock::now();
  workspaces.resize(static_cast<std::size_t>(std::max(1, team)));
  std::vector<Run> runs;
  std::size_t most_rows = 0;
  for (auto& begun : starts) {
    Optimiser& search = *begun.search;
    runs.push_back({search, std::move(begun.history)});
    Run& run = runs.back();
    run.spent_before_s = run.history.elapsed_s;
    run.history.reserve(stored_generations(setting.rules), stored_members(search, setting), search.dimension());
    most_rows += search.largest_batch();
    // killed between its last generation and its end
    if (!run.history.best.empty())
      run.reason = reason_to_stop(setting.rules, search, setting.objective.bounds(), run.spent_before_s);
  }
  std::size_t const dimension = setting.objective.dimension();
  std::vector<double> candidates(most_rows * dimension), fitness(most_rows);
  MatrixView<double> const places(candidates.data(), most_rows, dimension);

  while (std::any_of(runs.begin(), runs.end(), [](Run const& run) { return !run.reason; })) {
    stop_if_requested(runs, setting);
    std::size_t rows = 0;
    for (Run& run : runs) {
      if (run.reason) continue;
      std::size_t const batch = run.search.batch_size();
      run.first = rows;
      run.search.ask(places.rows(rows, batch));
      // an evaluation budget ends exactly: the last batch may be cut, and the next run's begins there
      run.rows = allowed_rows(setting.rules, run.search.progress(), batch);
      rows += run.rows;
    }
    evaluate(setting.objective, places.rows(0, rows), std::span(fitness).first(rows), team, workspaces);
    if (setting.count_evaluations) setting.count_evaluations(static_cast<std::int64_t>(rows));
    bool const timed = setting.rules.wall_clock_s > 0.0;
    double const elapsed_s = timed ? std::chrono::duration<double>(Clock::now() - start).count() : 0.0;
    for (Run& run : runs) {
      if (run.reason) continue;
      remember_state_before_cut(run);
      run.search.tell(places.rows(run.first, run.rows), std::span(fitness).subspan(run.first, run.rows));
      record(run.search, setting, run.history);
      run.history.elapsed_s = run.spent_before_s + elapsed_s;
      run.reason = reason_to_stop(setting.rules, run.search, setting.objective.bounds(), run.history.elapsed_s);
    }
    if (setting.keep_now && setting.keep_now()) keep(runs, setting);
  }
  std::vector<RunHistory> histories;
  for (Run& run : runs) histories.push_back(finished(run, setting));
  return histories;
}

std::size_t runs_side_by_side(Objective const& objective, StopRules const& rules, std::size_t batch_size) {
  if (objective.bytes_swept() <= cached_bytes || rules.wall_clock_s > 0.0) return 1;
  return std::max<std::size_t>(1, (candidates_per_sweep + batch_size / 2) / batch_size);
}

}  // namespace torquescope
