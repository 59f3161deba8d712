#include "engine/fit/optim/crossover.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace torquescope {
namespace crossover_test {

constexpr std::size_t dimension = 6;
constexpr std::array<double, dimension> target{};

// how many of the parameters come from the mutant, per parameter, over many draws
std::array<int, dimension> counts_from_mutant(double CR, std::uint32_t draws,
                                              std::array<int, dimension + 1>* totals = nullptr) {
  std::array<int, dimension> counts{};
  for (std::uint32_t draw = 0; draw < draws; ++draw) {
    RandomStream random({3, 0, RandomDomain::test}, draw, 0);
    std::array<double, dimension> trial;
    trial.fill(1.0);
    cross_binomial(random, CR, target, trial);
    std::size_t total = 0;
    for (std::size_t j = 0; j < dimension; ++j) {
      counts[j] += trial[j] == 1.0 ? 1 : 0;
      total += trial[j] == 1.0 ? 1 : 0;
    }
    if (totals) ++(*totals)[total];
  }
  return counts;
}

TEST(BinomialCrossover, ChoosesNumbersOfAnyKindAsTheyAre) {
  double const inf = std::numeric_limits<double>::infinity();
  for (double const x : {0.0, -0.0, 1.5, inf}) {
    EXPECT_EQ(std::signbit(chosen(true, x, -1.0)), std::signbit(x));
    EXPECT_EQ(chosen(true, x, -1.0), x);
    EXPECT_EQ(chosen(false, -1.0, x), x);
  }
  EXPECT_TRUE(std::isnan(chosen(true, std::nan(""), 1.0)));
}

TEST(BinomialCrossover, AlwaysTakesOneParameterOfTheMutant) {
  std::array<int, dimension + 1> totals{};
  counts_from_mutant(0.1, 5000, &totals);
  EXPECT_EQ(totals[0], 0);
}

TEST(BinomialCrossover, WithoutRateTakesExactlyOne) {
  std::array<int, dimension + 1> totals{};
  auto const counts = counts_from_mutant(0.0, 6000, &totals);
  EXPECT_EQ(totals[1], 6000);
  // each parameter is j_rand once in six: 1000 +- 5 standard deviations of 28.9
  for (int const count : counts) EXPECT_NEAR(count, 1000, 145);
}

TEST(BinomialCrossover, WithFullRateTakesTheWholeMutant) {
  for (int const count : counts_from_mutant(1.0, 500)) EXPECT_EQ(count, 500);
}

TEST(BinomialCrossover, TakesEachParameterWithItsProbability) {
  constexpr double CR = 0.3;
  constexpr double draws = 20000.0;
  // drawn, or else j_rand
  constexpr double probability = CR + (1.0 - CR) / dimension;
  double const five_deviations = 5.0 * std::sqrt(draws * probability * (1.0 - probability));
  for (int const count : counts_from_mutant(CR, 20000)) EXPECT_NEAR(count, draws * probability, five_deviations);
}

}  // namespace crossover_test
}  // namespace torquescope
