#include "engine/fit/optim/population.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

namespace torquescope {

Population::Population(std::size_t n_members, std::size_t dimension_)
    : dimension(dimension_),
      numbers(n_members * dimension_, 0.0),
      fitness(n_members, std::numeric_limits<double>::infinity()) {}

void Population::keep_best(std::size_t n_members) {
  TORQUESCOPE_EXPECT(n_members <= size());
  auto kept = ranking(fitness);
  kept.resize(n_members);
  std::sort(kept.begin(), kept.end());
  // each moves towards the front, or stays
  for (std::size_t to = 0; to < n_members; ++to) {
    if (kept[to] != to) set_member(to, members().row(kept[to]), fitness[kept[to]]);
  }
  numbers.resize(n_members * dimension);
  fitness.resize(n_members);
}

std::vector<std::size_t> ranking(std::span<double const> fitness) {
  std::vector<std::size_t> order(fitness.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return fitness[a] < fitness[b]; });
  return order;
}

void fill_initial_population(RandomKey key, Bounds const& bounds, MatrixView<double> members,
                             std::uint32_t generation) {
  TORQUESCOPE_EXPECT(members.columns() == bounds.dimension());
  for (std::size_t i = 0; i < members.rows(); ++i) {
    RandomStream random(key, generation, static_cast<std::uint32_t>(i));
    for (std::size_t j = 0; j < members.columns(); ++j) {
      // the product may round up to the width, the sum beyond the upper bound
      members(i, j) = std::min(random.uniform(bounds.lower[j], bounds.upper[j]), bounds.upper[j]);
    }
  }
}

double population_width(MatrixView<double const> members, Bounds const& bounds) {
  TORQUESCOPE_EXPECT(members.columns() == bounds.dimension() && members.rows() >= 1);
  double width = 0.0;
  for (std::size_t j = 0; j < members.columns(); ++j) {
    double least = members(0, j);
    double most = least;
    for (std::size_t i = 1; i < members.rows(); ++i) {
      least = std::min(least, members(i, j));
      most = std::max(most, members(i, j));
    }
    width = std::max(width, (most - least) / (bounds.upper[j] - bounds.lower[j]));
  }
  return width;
}

}  // namespace torquescope
