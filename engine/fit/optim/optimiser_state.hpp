#pragma once
// What every search saves, and reading a saved state back: every entry is checked before anything is changed.
//
// State      entries "kind <name>", "key", "progress", "best", "population", "fitness"; a kind adds its own
// Errors     std::invalid_argument: an entry is missing or has another number of values; another kind or key

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/fit/optim/optimiser.hpp"
#include "engine/fit/optim/population.hpp"

namespace torquescope {

std::vector<double> const& state_entry(OptimiserState const& state, std::string const& name, std::size_t size);
// least to most whole rows of `columns` numbers
std::vector<double> const& state_rows(OptimiserState const& state, std::string const& name, std::size_t columns,
                                      std::size_t least, std::size_t most);

// a key as numbers that doubles hold exactly: seed high, seed low, run, domain
std::vector<double> numbers_of(RandomKey key);

struct SavedSearch {
  Progress progress;
  Population population;
};

OptimiserState saved_state(std::string const& kind, RandomKey key, Progress const& progress,
                           Population const& population);
// for who keeps populations elsewhere: the same without it, and with it again (numbers: member by member)
OptimiserState without_population(OptimiserState state);
OptimiserState with_population(OptimiserState state, std::span<double const> numbers, std::span<double const> fitness);
// that was told last
std::int64_t generation_of(OptimiserState const& state);
// the population has between least and most members
SavedSearch saved_search(OptimiserState const& state, std::string const& kind, RandomKey key, std::size_t dimension,
                         std::size_t least, std::size_t most);

}  // namespace torquescope
