#include "engine/fit/optim/population.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/optimise.hpp"

namespace torquescope {
namespace population_test {

RandomKey const key{7, 0, RandomDomain::test};

TEST(InitialPopulation, IsUniformInTheBox) {
  Bounds const bounds{{-1.0, 10.0}, {3.0, 11.0}};
  constexpr std::size_t n = 4000;
  Population population(n, 2);
  fill_initial_population(key, bounds, population.members());
  for (std::size_t j = 0; j < 2; ++j) {
    double const width = bounds.upper[j] - bounds.lower[j];
    std::array<int, 10> tenths{};
    for (std::size_t i = 0; i < n; ++i) {
      double const share = (population.members()(i, j) - bounds.lower[j]) / width;
      ASSERT_GE(share, 0.0);
      ASSERT_LE(share, 1.0);
      ++tenths[std::min<std::size_t>(9, static_cast<std::size_t>(10.0 * share))];
    }
    // chi-square with 9 degrees of freedom exceeds 27.9 once in 1000
    double chi_square = 0.0;
    for (int const count : tenths) chi_square += std::pow(count - n / 10.0, 2) / (n / 10.0);
    EXPECT_LT(chi_square, 27.9);
  }
}

TEST(InitialPopulation, MemberDoesNotDependOnHowManyThereAre) {
  Bounds const bounds = testing::cube(3, 0.0, 1.0);
  Population few(5, 3);
  Population many(50, 3);
  fill_initial_population(key, bounds, few.members());
  fill_initial_population(key, bounds, many.members());
  for (std::size_t k = 0; k < few.numbers.size(); ++k) EXPECT_EQ(few.numbers[k], many.numbers[k]);
}

TEST(PopulationWidth, IsTheLargestShareOfTheBox) {
  Bounds const bounds{{0.0, -10.0}, {1.0, 10.0}};
  Population population(3, 2);
  population.numbers = {0.2, -5.0, 0.3, 0.0, 0.25, 5.0};
  EXPECT_DOUBLE_EQ(population_width(population.members(), bounds), 0.5);
  population.numbers = {0.2, 1.0, 0.2, 1.0, 0.2, 1.0};
  EXPECT_EQ(population_width(population.members(), bounds), 0.0);
}

TEST(Population, KeepsItsBestInTheirOrder) {
  Population population(5, 2);
  constexpr double inf = std::numeric_limits<double>::infinity();
  std::vector<double> const fitness{3.0, inf, 1.0, 3.0, 2.0};
  for (std::size_t i = 0; i < 5; ++i)
    population.set_member(i, std::vector{static_cast<double>(i), 10.0 * static_cast<double>(i)}, fitness[i]);
  EXPECT_EQ(ranking(fitness), (std::vector<std::size_t>{2, 4, 0, 3, 1}));
  population.keep_best(3);
  EXPECT_EQ(population.fitness, (std::vector{3.0, 1.0, 2.0}));
  EXPECT_EQ(population.numbers, (std::vector{0.0, 0.0, 2.0, 20.0, 4.0, 40.0}));
}

}  // namespace population_test
}  // namespace torquescope
