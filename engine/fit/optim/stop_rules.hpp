#pragma once
// When a search ends. A rule set to 0 (the target: -inf) is off; the first that holds, in this order, is the reason:
//
//   target          best fitness <= target, absolute: also right for negative fitness
//   fitness_range   largest - smallest fitness of the population <= this, absolute: an offset does not matter
//   width           largest extent of the population <= width * box, along every parameter
//   stagnation      this many generations since the best fitness last fell (any decrease counts, however small)
//   generations     after the initial population
//   evaluations     exactly: allowed_rows() says how much of the next batch fits
//   wall_clock_s    seconds, by the caller's clock; the only rule that can differ between two runs of one job
//
// Threads    pure functions

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/matrix_view.hpp"
#include "engine/base/options.hpp"
#include "engine/fit/optim/optimiser.hpp"

namespace torquescope {

struct StopRules {
  double target = -std::numeric_limits<double>::infinity();
  double fitness_range = 0.0;
  double width = 0.0;
  std::int64_t stagnation = 0;
  std::int64_t generations = 100;
  std::int64_t evaluations = 0;
  double wall_clock_s = 0.0;

  // section [stop]
  static OptionTable<StopRules> const& table();
  // nothing if the search is sure to end; else what to tell the user
  std::optional<Problem> endless(Section const& section) const;
};

enum class StopReason { target, fitness_range, width, stagnation, generations, evaluations, wall_clock };

// "target", "fitness_range", ...: what the result file stores
std::string to_string(StopReason reason);

// after a tell(); nothing while the search should go on
std::optional<StopReason> reason_to_stop(StopRules const& rules, Optimiser const& search, Bounds const& bounds,
                                         double elapsed_s);

// of evaluations or generations, whichever is nearer its end; 0 where neither is limited, above 1 behind the end
double share_spent(StopRules const& rules, Progress const& progress);

// keys of the rules that might end a search earlier than those of `before` did; wall_clock_s is none of them
std::vector<std::string> stricter_rules(StopRules const& now, StopRules const& before);

// rows of the next batch that may still be evaluated
std::size_t allowed_rows(StopRules const& rules, Progress const& progress, std::size_t batch_size);

}  // namespace torquescope
