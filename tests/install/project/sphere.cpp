// A stranger's program: minimises the sum of squares with the installed FADE.
#include <cstdio>
#include <vector>

#include "engine/fit/optim/optimiser.hpp"

int main() {
  using namespace torquescope;
  Bounds const box{{-5.0, -5.0, -5.0}, {5.0, 5.0, 5.0}};
  std::vector<Problem> problems;
  auto const make = find_optimiser("fade")->prepare(Section{}, {}, problems);
  auto const fade = make(box, RandomKey{1, 0});
  double best = 1e300;
  for (int generation = 0; generation < 200; ++generation) {
    std::vector<double> rows(fade->batch_size() * 3), fitness(fade->batch_size());
    MatrixView<double> candidates(rows.data(), fade->batch_size(), 3);
    fade->ask(candidates);
    for (std::size_t i = 0; i < fitness.size(); ++i) {
      fitness[i] = 0.0;
      for (double x : candidates.row(i)) fitness[i] += x * x;
    }
    fade->tell(candidates, fitness);
    best = fade->progress().best_fitness;
  }
  std::printf(best < 1e-6 ? "best fitness below 1e-6\n" : "not converged: %g\n", best);
  return best < 1e-6 ? 0 : 1;
}
