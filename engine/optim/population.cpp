#include "engine/optim/population.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace torquescope {

Population::Population(std::size_t n_members, std::size_t dimension_)
    : dimension(dimension_),
      numbers(n_members * dimension_, 0.0),
      fitness(n_members, std::numeric_limits<double>::infinity()) {}

void fill_initial_population(RandomKey key, Bounds const& bounds, MatrixView<double> members) {
  TORQUESCOPE_EXPECT(members.columns() == bounds.dimension());
  for (std::size_t i = 0; i < members.rows(); ++i) {
    RandomStream random(key, 0, static_cast<std::uint32_t>(i));
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
