#pragma once
// Reading a saved state back: every entry is checked before anything is changed.
//
// Errors     std::invalid_argument: an entry is missing or has another number of values

#include <cstddef>
#include <string>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/optim/optimiser.hpp"

namespace torquescope {

std::vector<double> const& state_entry(OptimiserState const& state, std::string const& name, std::size_t size);

// a key as numbers that doubles hold exactly: seed high, seed low, run, domain
std::vector<double> numbers_of(RandomKey key);

// every number of a Progress but the best member
std::vector<double> numbers_of(Progress const& progress);
Progress progress_of(std::vector<double> const& numbers, std::vector<double> const& best);

}  // namespace torquescope
