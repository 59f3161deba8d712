#pragma once
// DE/rand/1/bin on a batch evaluator, as short as it can be written: what a user of a matrix library writes around it.
//
// evaluate(members, fitness): n_members rows of R parameters -> their MSE

#include <algorithm>
#include <random>
#include <vector>

#include "bench/peers/problem.hpp"

namespace peers {

template <class Evaluate>
double differential_evolution(Problem const& problem, unsigned seed, Evaluate&& evaluate) {
  std::size_t const R = problem.R;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::uniform_int_distribution<std::size_t> any_member(0, n_members - 1), any_parameter(0, R - 1);
  std::vector<double> population(n_members * R), trials(n_members * R), fitness(n_members), trial_fitness(n_members);
  for (double& x : population) x = 2.0 * uniform(random) - 1.0;
  evaluate(population.data(), fitness.data());
  for (unsigned generation = 0; generation < n_generations; ++generation) {
    for (std::size_t m = 0; m < n_members; ++m) {
      std::size_t a, b, c;
      do a = any_member(random);
      while (a == m);
      do b = any_member(random);
      while (b == m || b == a);
      do c = any_member(random);
      while (c == m || c == a || c == b);
      std::size_t const certain = any_parameter(random);
      for (std::size_t r = 0; r < R; ++r) {
        bool const crosses = r == certain || uniform(random) < CR;
        double x = crosses ? population[a * R + r] + F * (population[b * R + r] - population[c * R + r])
                           : population[m * R + r];
        if (x < -1.0 || x > 1.0) x = 2.0 * uniform(random) - 1.0;
        trials[m * R + r] = x;
      }
    }
    evaluate(trials.data(), trial_fitness.data());
    for (std::size_t m = 0; m < n_members; ++m) {
      if (trial_fitness[m] > fitness[m]) continue;
      fitness[m] = trial_fitness[m];
      std::copy_n(&trials[m * R], R, &population[m * R]);
    }
  }
  return *std::min_element(fitness.begin(), fitness.end());
}

}  // namespace peers
