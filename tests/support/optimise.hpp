#pragma once
// A loop for tests: one optimiser, one function, no recording, no stop rule but a number of generations.

#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/fit/optim/optimiser.hpp"
#include "engine/fit/optim/stop_rules.hpp"

namespace torquescope::testing {

using Fitness = std::function<double(std::span<double const>)>;

inline Section estimator_section(std::vector<Setting> settings) { return {"estimator", {}, std::move(settings)}; }

// a search as a job would make it
inline std::unique_ptr<Optimiser> make_optimiser(std::string const& name, Bounds const& bounds, RandomKey key,
                                                 std::vector<Setting> settings = {}) {
  OptimiserChoice const* choice = find_optimiser(name);
  if (!choice) throw std::invalid_argument("no optimiser " + name);
  std::vector<Problem> problems;
  std::vector<std::string> stop_keys;
  for (auto const& option : StopRules::table().describe()) stop_keys.push_back(option.key);
  auto const make = choice->prepare(estimator_section(std::move(settings)), stop_keys, problems);
  if (!problems.empty()) throw Error(problems);
  return make(bounds, key);
}

struct Batch {
  std::size_t dimension;
  std::vector<double> numbers;
  std::vector<double> fitness;
  MatrixView<double> rows() { return {numbers.data(), fitness.size(), dimension}; }
};

inline Batch ask(Optimiser const& search) {
  Batch batch{search.dimension(), std::vector<double>(search.batch_size() * search.dimension()),
              std::vector<double>(search.batch_size())};
  search.ask(batch.rows());
  return batch;
}

inline Batch asked_and_evaluated(Optimiser const& search, Fitness const& fitness) {
  Batch batch = ask(search);
  for (std::size_t i = 0; i < batch.fitness.size(); ++i) batch.fitness[i] = fitness(batch.rows().row(i));
  return batch;
}

// the initial population first, then generations up to and including the last one
inline void run_to_generation(Optimiser& search, Fitness const& fitness, std::int64_t last) {
  while (search.progress().evaluations == 0 || search.progress().generation < last) {
    Batch batch = asked_and_evaluated(search, fitness);
    search.tell(batch.rows(), batch.fitness);
  }
}

inline std::vector<double> members_of(Optimiser const& search) {
  auto const members = search.population();
  return {members.data(), members.data() + members.rows() * members.columns()};
}

// several minima, values that are multiples of 2^-20: sums with whole numbers are exact
inline double bumpy(std::span<double const> x) {
  double sum = 0.0;
  for (double const v : x) sum += v * v + std::cos(7.0 * v);
  return std::round(sum * 0x1p20) * 0x1p-20;
}

inline Bounds cube(std::size_t dimension, double lower, double upper) {
  return {std::vector<double>(dimension, lower), std::vector<double>(dimension, upper)};
}

}  // namespace torquescope::testing
