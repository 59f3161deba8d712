#include "engine/fit/optim/search_progress.hpp"

#include <cstdint>
#include <limits>

#include "engine/fit/optim/selection.hpp"

namespace torquescope {

Progress no_progress(std::size_t dimension) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Progress progress;
  progress.best_fitness = std::numeric_limits<double>::infinity();
  progress.best.assign(dimension, none);
  progress.F = progress.CR = progress.PC = progress.FC = none;
  return progress;
}

void count_batch(Progress& progress, std::span<double const> fitness) {
  progress.evaluations += static_cast<std::int64_t>(fitness.size());
  progress.nonfinite += static_cast<std::int64_t>(count_nonfinite(fitness));
}

void record_best(Progress& progress, Population const& population) {
  std::size_t const best = best_index(population.fitness);
  double const best_fitness = population.fitness[best];
  // only a smaller value is news
  if (!(best_fitness < progress.best_fitness)) return;
  progress.best_fitness = best_fitness;
  progress.last_improvement = progress.generation;
  auto const member = population.members().row(best);
  progress.best.assign(member.begin(), member.end());
}

void record_batch(MatrixView<double const> asked, std::span<double const> fitness, Population& told,
                  Progress& progress) {
  for (std::size_t i = 0; i < fitness.size(); ++i) told.set_member(i, asked.row(i), ranked_fitness(fitness[i]));
  count_batch(progress, fitness);
  record_best(progress, told);
}

}  // namespace torquescope
