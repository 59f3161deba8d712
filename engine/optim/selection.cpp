#include "engine/optim/selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace torquescope {

bool trial_wins(double trial_fitness, double target_fitness) {
  return std::isfinite(trial_fitness) && trial_fitness <= ranked_fitness(target_fitness);
}

double ranked_fitness(double fitness) {
  return std::isfinite(fitness) ? fitness : std::numeric_limits<double>::infinity();
}

std::size_t count_nonfinite(std::span<double const> fitness) {
  return static_cast<std::size_t>(
      std::count_if(fitness.begin(), fitness.end(), [](double f) { return !std::isfinite(f); }));
}

std::size_t select(MatrixView<double const> trials, std::span<double const> trial_fitness, Population& population) {
  TORQUESCOPE_EXPECT(trials.rows() <= population.size() && trial_fitness.size() == trials.rows());
  std::size_t winners = 0;
  for (std::size_t i = 0; i < trials.rows(); ++i) {
    if (!trial_wins(trial_fitness[i], population.fitness[i])) continue;
    auto const trial = trials.row(i);
    std::copy(trial.begin(), trial.end(), population.members().row(i).begin());
    population.fitness[i] = trial_fitness[i];
    ++winners;
  }
  return winners;
}

std::size_t best_index(std::span<double const> fitness) {
  TORQUESCOPE_EXPECT(!fitness.empty());
  return static_cast<std::size_t>(std::min_element(fitness.begin(), fitness.end()) - fitness.begin());
}

}  // namespace torquescope
