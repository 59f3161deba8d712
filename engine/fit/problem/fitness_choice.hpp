#pragma once
// Whether a search looks at every sample or at sufficient statistics, and why, in words.
//
// Rule       fitness = "auto" and "gram" take statistics where the loss is squares and SufficientStatistics are usable;
//            "auto" only when the search evaluates often enough to repay their sweeps; else every sample ("direct")
//            precision = "float32" takes every sample, in float32
// Threads    free functions

#include <cstdint>
#include <string>

#include "engine/fit/problem/objective_options.hpp"
#include "engine/fit/problem/single_precision.hpp"
#include "engine/fit/problem/sufficient_statistics.hpp"

namespace torquescope {

struct FitnessChoice {
  bool from_statistics = false;
  bool in_float32 = false;
  std::string words;  // "statistics (auto): ...", for the log and the result file
  bool by_rollouts = false;
};

// whether statistics have to be made: decided before they are, which costs two sweeps; evaluations: at most, of all
// runs
bool wants_statistics(ObjectiveOptions const& options, Eigen::Index n_parameters, std::int64_t evaluations);

// statistics: may be nullptr when wants_statistics() says no
FitnessChoice choose_fitness(ObjectiveOptions const& options, Eigen::Index n_parameters, std::int64_t evaluations,
                             SufficientStatistics const* statistics);

// of precision = "float32"
// Requires   check.usable()
FitnessChoice single_precision_choice(ObjectiveOptions const& options, SinglePrecisionCheck const& check);

}  // namespace torquescope
