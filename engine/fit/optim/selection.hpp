#pragma once
// One-to-one selection: the trial vector takes the target's place when it is not worse.
//
// Equation   f(u) <= f(x): ties are accepted, so that a plateau can be crossed               (seed eq. 7)
//            A candidate without finite fitness never wins, not even against another one.

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "engine/base/matrix_view.hpp"
#include "engine/fit/optim/population.hpp"

namespace torquescope {

// finite numbers as they are; NaN, +inf and -inf become +inf: worst
inline double ranked_fitness(double fitness) {
  return std::isfinite(fitness) ? fitness : std::numeric_limits<double>::infinity();
}

inline bool trial_wins(double trial_fitness, double target_fitness) {
  // & instead of &&: both are cheap, and a branch that depends on fitness is not
  auto const is_finite = static_cast<int>(std::isfinite(trial_fitness));
  auto const is_better = static_cast<int>(trial_fitness <= ranked_fitness(target_fitness));
  return (is_finite & is_better) != 0;
}

std::size_t count_nonfinite(std::span<double const> fitness);

// trials compete with the first members, row by row; `winners` becomes the list of those that won, ascending
void select(MatrixView<double const> trials, std::span<double const> trial_fitness, Population& population,
            std::vector<std::size_t>& winners);

// index of the smallest; the first of equals
std::size_t best_index(std::span<double const> fitness);

}  // namespace torquescope
