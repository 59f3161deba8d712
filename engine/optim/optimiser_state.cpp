#include "engine/optim/optimiser_state.hpp"

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

std::vector<double> numbers_of(RandomKey key) {
  return {static_cast<double>(key.seed >> 32), static_cast<double>(key.seed & 0xffffffffu),
          static_cast<double>(key.run), static_cast<double>(static_cast<std::uint32_t>(key.domain))};
}

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

}  // namespace torquescope
