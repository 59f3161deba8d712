#pragma once
// Everything one run of a population method leaves behind: what RESULT_FORMAT.md stores under /runs/<estimator>.
//
// Shapes     G + 1 entries per list (generation 0 is the initial population), NP x R numbers per population; entries
//            after the run has stopped are NaN (evaluations: the last count), and so are members that a shrinking
//            population no longer has
// Threads    plain record of one run

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "engine/fit/optim/optimiser.hpp"

namespace torquescope {

struct RunHistory {
  // one entry per generation told, in their order
  std::vector<double> population;
  std::vector<double> fitness;
  std::vector<double> F, CR, PC, FC;
  std::vector<double> best;  // best fitness so far, as MSE
  std::vector<double> gap;   // best minus the OLS floor, as MSE
  std::vector<std::int64_t> evaluations;

  std::vector<double> parameters;  // the best candidate
  std::string stop_reason;
  std::int64_t nonfinite = 0;  // candidates without finite fitness
  double elapsed_s = 0.0;      // spent on it, by the clock that the rule wall_clock_s reads
  // of the last whole batch, without its population, which stands above: what a longer search goes on from. Empty where
  // populations are not kept, or where a budget ended the run within its first batch
  OptimiserState last_state{};
  std::size_t told = 0;  // generations that really were, once it has ended; behind them is padding

  // room for what pad() will fill: a run touches the part that its generations really need
  void reserve(std::size_t entries, std::size_t members, std::size_t dimension) {
    population.reserve(entries * members * dimension);
    fitness.reserve(entries * members);
    for (auto* list : {&F, &CR, &PC, &FC, &best, &gap}) list->reserve(entries);
    evaluations.reserve(entries);
  }

  // rows that a population which has shrunk left empty in the generation just recorded
  void pad_population(std::size_t members, std::size_t dimension) {
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    population.resize(population.size() + members * dimension, not_a_number);
    fitness.resize(fitness.size() + members, not_a_number);
  }

  // fills up to `entries` generations of `members` x `dimension`: all runs of an estimator are stored at one size
  void pad(std::size_t entries, std::size_t members, std::size_t dimension) {
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    population.resize(entries * members * dimension, not_a_number);
    fitness.resize(entries * members, not_a_number);
    for (auto* list : {&F, &CR, &PC, &FC, &best, &gap}) list->resize(entries, not_a_number);
    evaluations.resize(entries, evaluations.empty() ? 0 : evaluations.back());
  }
};

// of a run under way, what it can go on from
struct RunSoFar {
  RunHistory const& history;
  std::size_t generations;                // of it, from the first on
  std::function<OptimiserState()> state;  // behind these; made when it is wanted
};

}  // namespace torquescope
