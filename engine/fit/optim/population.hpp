#pragma once
// Members and their fitness, and how they begin: uniform in the box.
//
// Equation   x_ij = lower_j + u_ij (upper_j - lower_j), u in [0, 1)                     (seed eq. 4)
// Random     u_ij is draw j of the stream (key, generation, member i)
// Shapes     members x dimension, row-major; fitness: one number per member, +inf where there is no finite one
// Threads    free functions on the caller's numbers

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/matrix_view.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/fit/optim/objective.hpp"

namespace torquescope {

struct Population {
  Population() = default;
  Population(std::size_t n_members, std::size_t dimension);

  std::size_t size() const { return fitness.size(); }
  MatrixView<double> members() { return {numbers.data(), size(), dimension}; }
  MatrixView<double const> members() const { return {numbers.data(), size(), dimension}; }

  void set_member(std::size_t i, std::span<double const> parameters, double its_fitness) {
    std::copy(parameters.begin(), parameters.end(), members().row(i).begin());
    fitness[i] = its_fitness;
  }

  // of equally good ones the first, and all in their order
  void keep_best(std::size_t n_members);

  std::size_t dimension = 0;
  std::vector<double> numbers;
  std::vector<double> fitness;
};

void fill_initial_population(RandomKey key, Bounds const& bounds, MatrixView<double> members,
                             std::uint32_t generation = 0);

// indices from the best member to the worst, equally good ones in their order
std::vector<std::size_t> ranking(std::span<double const> fitness);

// largest extent of the members along any parameter, as a share of the box: 1 when they span it, 0 when all are equal
double population_width(MatrixView<double const> members, Bounds const& bounds);

}  // namespace torquescope
