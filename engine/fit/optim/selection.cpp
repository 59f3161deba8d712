#include "engine/fit/optim/selection.hpp"

#include <algorithm>

namespace torquescope {

std::size_t count_nonfinite(std::span<double const> fitness) {
  return static_cast<std::size_t>(
      std::count_if(fitness.begin(), fitness.end(), [](double f) { return !std::isfinite(f); }));
}

void select(MatrixView<double const> trials, std::span<double const> trial_fitness, Population& population,
            std::vector<std::size_t>& winners) {
  TORQUESCOPE_EXPECT(trials.rows() <= population.size() && trial_fitness.size() == trials.rows());
  // nobody can predict who wins, so no branch depends on it
  winners.resize(trials.rows());
  std::size_t n_winners = 0;
  for (std::size_t i = 0; i < trials.rows(); ++i) {
    winners[n_winners] = i;
    n_winners += trial_wins(trial_fitness[i], population.fitness[i]) ? 1 : 0;
  }
  winners.resize(n_winners);
  for (std::size_t const i : winners) population.set_member(i, trials.row(i), trial_fitness[i]);
}

std::size_t best_index(std::span<double const> fitness) {
  TORQUESCOPE_EXPECT(!fitness.empty());
  return static_cast<std::size_t>(std::min_element(fitness.begin(), fitness.end()) - fitness.begin());
}

}  // namespace torquescope
