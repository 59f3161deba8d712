#pragma once
// Runs of a population method: ask, evaluate, tell, record, until a rule says stop. Several runs of one estimator go
// side by side, generation by generation, and share one sweep over the recording; each ends when its own rules say so.
//
// Bits       each history depends on its optimiser's key alone: not on its neighbours, nor on the size of the team, nor
//            on where it was interrupted and went on
// Errors     Error 75 when stop_requested() says so between two generations, every run having been kept; an exception
//            of one run ends them all
// Threads    all runs of a call in the caller's thread; a team of more than one splits each batch into blocks of
//            candidates

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/experiment/runs/run_history.hpp"
#include "engine/fit/optim/objective.hpp"
#include "engine/fit/optim/optimiser.hpp"
#include "engine/fit/optim/stop_rules.hpp"

namespace torquescope {

// one run that begins, or that goes on behind the generations which its history has (its optimiser is restored then)
struct RunStart {
  std::unique_ptr<Optimiser> search;
  RunHistory history{};
};

// what the loop needs beside the optimiser; shared by all runs of an estimator
struct SearchSetting {
  Objective const& objective;
  StopRules const& rules;
  double fitness_to_mse = 1.0;                                        // 1 for MSE, 1/n for SSE
  std::function<double(std::span<double const>)> gap_to_floor;        // MSE above the OLS floor, without cancellation
  std::function<void(std::int64_t evaluations)> count_evaluations{};  // called once a sweep, any thread
  std::function<bool()> stop_requested{};
  bool keeps_populations = true;  // false: population and fitness of a history stay empty
  // asked after every generation; when true, and before a stop, keep() gets each run (index: place among the starts)
  std::function<bool()> keep_now{};
  std::function<void(std::size_t index, RunSoFar const& so_far)> keep{};
};

// one history per start, in their order
std::vector<RunHistory> optimise(std::vector<RunStart> starts, SearchSetting const& setting, int team,
                                 std::vector<Workspace>& workspaces);

// how many runs of this population size should go side by side, at most (run_scheduler.hpp spreads them): more than one
// where the recording does not stay in the cache. One where a rule counts seconds: they are of one run alone.
std::size_t runs_side_by_side(Objective const& objective, StopRules const& rules, std::size_t batch_size);

}  // namespace torquescope
