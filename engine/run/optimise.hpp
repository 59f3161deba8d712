#pragma once
// One run of a population method: ask, evaluate, tell, record, until a rule says stop.
//
// Bits       the history depends on the optimiser's key alone, not on the size of the team
// Errors     Error 75 when stop_requested() says so between two generations
// Threads    one run per call; a team of more than one splits each batch into blocks of candidates

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/optim/objective.hpp"
#include "engine/optim/optimiser.hpp"
#include "engine/optim/stop_rules.hpp"
#include "engine/run/run_history.hpp"

namespace torquescope {

// what the loop needs beside the optimiser; shared by all runs of an estimator
struct SearchSetting {
  Objective const& objective;
  StopRules const& rules;
  double fitness_to_mse = 1.0;                                        // 1 for MSE, 1/n for SSE
  std::function<double(std::span<double const>)> gap_to_floor;        // MSE above the OLS floor, without cancellation
  std::function<void(std::int64_t evaluations)> count_evaluations{};  // called once a generation, any thread
  std::function<bool()> stop_requested{};
};

RunHistory optimise(Optimiser& optimiser, SearchSetting const& setting, int team, std::vector<Workspace>& workspaces);

}  // namespace torquescope
