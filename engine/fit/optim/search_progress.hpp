#pragma once
// Progress that every search counts in the same way: nothing yet, one batch more, a new best.

#include <cstddef>
#include <span>

#include "engine/fit/optim/optimiser.hpp"
#include "engine/fit/optim/population.hpp"

namespace torquescope {

// before the first batch: best fitness +inf, everything an optimiser may not have NaN
Progress no_progress(std::size_t dimension);

// evaluations, and those without finite fitness
void count_batch(Progress& progress, std::span<double const> fitness);

// a member better than any before it, found in progress.generation
void record_best(Progress& progress, Population const& population);

// of a search that keeps no members: the candidates told last, and what they say, in progress.generation
void record_batch(MatrixView<double const> asked, std::span<double const> fitness, Population& told,
                  Progress& progress);

}  // namespace torquescope
