#include "engine/fit/optim/optimiser_state.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>

namespace torquescope {

std::vector<double> const& state_entry(OptimiserState const& state, std::string const& name, std::size_t size) {
  auto const found = state.find(name);
  if (found == state.end()) throw std::invalid_argument(fmt::format("the saved state has no entry \"{}\"", name));
  if (found->second.size() != size) {
    throw std::invalid_argument(
        fmt::format("entry \"{}\" of the saved state has {} numbers, not {}", name, found->second.size(), size));
  }
  return found->second;
}

std::vector<double> const& state_rows(OptimiserState const& state, std::string const& name, std::size_t columns,
                                      std::size_t least, std::size_t most) {
  auto const found = state.find(name);
  if (found == state.end()) throw std::invalid_argument(fmt::format("the saved state has no entry \"{}\"", name));
  std::size_t const size = found->second.size();
  if (size % columns != 0 || size < least * columns || size > most * columns) {
    throw std::invalid_argument(fmt::format("entry \"{}\" of the saved state has {} numbers, not {} to {} times {}",
                                            name, size, least, most, columns));
  }
  return found->second;
}

std::vector<double> numbers_of(RandomKey key) {
  return {static_cast<double>(key.seed >> 32), static_cast<double>(key.seed & 0xffffffffu),
          static_cast<double>(key.run), static_cast<double>(static_cast<std::uint32_t>(key.domain))};
}

namespace {

constexpr double state_version = 1.0;
constexpr std::size_t numbers_of_progress = 9;

// every number but the best member
std::vector<double> numbers_of(Progress const& progress) {
  return {static_cast<double>(progress.generation),
          static_cast<double>(progress.evaluations),
          static_cast<double>(progress.nonfinite),
          static_cast<double>(progress.last_improvement),
          progress.best_fitness,
          progress.F,
          progress.CR,
          progress.PC,
          progress.FC};
}

Progress progress_of(std::vector<double> const& numbers, std::vector<double> const& best) {
  Progress progress;
  progress.generation = static_cast<std::int64_t>(numbers.at(0));
  progress.evaluations = static_cast<std::int64_t>(numbers.at(1));
  progress.nonfinite = static_cast<std::int64_t>(numbers.at(2));
  progress.last_improvement = static_cast<std::int64_t>(numbers.at(3));
  progress.best_fitness = numbers.at(4);
  progress.F = numbers.at(5);
  progress.CR = numbers.at(6);
  progress.PC = numbers.at(7);
  progress.FC = numbers.at(8);
  progress.best = best;
  return progress;
}

}  // namespace

OptimiserState saved_state(std::string const& kind, RandomKey key, Progress const& progress,
                           Population const& population) {
  return {{"kind " + kind, {state_version}}, {"key", numbers_of(key)},           {"progress", numbers_of(progress)},
          {"best", progress.best},           {"population", population.numbers}, {"fitness", population.fitness}};
}

OptimiserState without_population(OptimiserState state) {
  state.erase("population");
  state.erase("fitness");
  return state;
}

OptimiserState with_population(OptimiserState state, std::span<double const> numbers, std::span<double const> fitness) {
  state["population"].assign(numbers.begin(), numbers.end());
  state["fitness"].assign(fitness.begin(), fitness.end());
  return state;
}

std::int64_t generation_of(OptimiserState const& state) {
  double const generation = state_entry(state, "progress", numbers_of_progress).front();
  constexpr double uncountable = 0x1p53;
  if (!(generation >= 0.0 && generation < uncountable)) {
    throw std::invalid_argument("the saved state has no generation");
  }
  return static_cast<std::int64_t>(generation);
}

SavedSearch saved_search(OptimiserState const& state, std::string const& kind, RandomKey key, std::size_t dimension,
                         std::size_t least, std::size_t most) {
  if (state_entry(state, "kind " + kind, 1).front() != state_version) {
    throw std::invalid_argument("the saved state is of another version of " + kind);
  }
  auto const key_numbers = numbers_of(key);
  if (state_entry(state, "key", key_numbers.size()) != key_numbers) {
    throw std::invalid_argument("the saved state belongs to another seed or run");
  }
  SavedSearch saved;
  saved.progress =
      progress_of(state_entry(state, "progress", numbers_of_progress), state_entry(state, "best", dimension));
  saved.population.dimension = dimension;
  saved.population.fitness = state_rows(state, "fitness", 1, least, most);
  saved.population.numbers = state_entry(state, "population", saved.population.size() * dimension);
  return saved;
}

}  // namespace torquescope
