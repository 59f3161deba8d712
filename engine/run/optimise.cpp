#include "engine/run/optimise.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "engine/base/error.hpp"
#include "engine/base/parallel.hpp"

namespace torquescope {

namespace {

// candidates of one task when a team splits a batch: two register groups of the kernel
constexpr std::size_t team_block = 12;

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

void record(Optimiser const& optimiser, SearchSetting const& setting, RunHistory& history) {
  Progress const& progress = optimiser.progress();
  auto const population = optimiser.population();
  history.population.insert(history.population.end(), population.data(),
                            population.data() + population.rows() * population.columns());
  auto const fitness = optimiser.fitness();
  history.fitness.insert(history.fitness.end(), fitness.begin(), fitness.end());
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

}  // namespace

RunHistory optimise(Optimiser& optimiser, SearchSetting const& setting, int team, std::vector<Workspace>& workspaces) {
  using Clock = std::chrono::steady_clock;
  auto const start = Clock::now();
  std::size_t const dimension = optimiser.dimension();
  RunHistory history;
  workspaces.resize(static_cast<std::size_t>(std::max(1, team)));
  std::vector<double> candidates, fitness;
  history.reserve(stored_generations(setting.rules), optimiser.batch_size(), dimension);

  std::optional<StopReason> reason;
  while (!reason) {
    if (setting.stop_requested && setting.stop_requested())
      throw Error(Problem{ExitCode::stopped,
                          "stopped by a signal: nothing was published",
                          {},
                          {},
                          {},
                          {},
                          "run the same command again"});
    std::size_t const batch = optimiser.batch_size();
    candidates.resize(batch * dimension);
    fitness.resize(batch);
    MatrixView<double> const asked(candidates.data(), batch, dimension);
    optimiser.ask(asked);
    // an evaluation budget ends exactly: the last batch may be cut
    std::size_t const rows = allowed_rows(setting.rules, optimiser.progress(), batch);
    std::span<double> const values(fitness.data(), rows);
    evaluate(setting.objective, asked.rows(0, rows), values, team, workspaces);
    optimiser.tell(asked.rows(0, rows), values);
    record(optimiser, setting, history);
    if (setting.count_evaluations) setting.count_evaluations(static_cast<std::int64_t>(rows));
    double const elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
    reason = reason_to_stop(setting.rules, optimiser, setting.objective.bounds(), elapsed_s);
  }
  history.pad(stored_generations(setting.rules), optimiser.batch_size(), dimension);
  history.parameters = optimiser.progress().best;
  history.stop_reason = to_string(*reason);
  history.nonfinite = optimiser.progress().nonfinite;
  return history;
}

}  // namespace torquescope
