#include "engine/fit/optim/mutation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/fit/optim/population.hpp"

namespace torquescope {
namespace mutation_test {

TEST(MutationRand1, PicksThreeDifferentMembersOtherThanTheTarget) {
  for (std::size_t const n : {4u, 5u, 30u}) {
    for (std::uint32_t draw = 0; draw < 2000; ++draw) {
      RandomStream random({1, 0, RandomDomain::test}, draw, 0);
      std::size_t const target = draw % n;
      auto const [r1, r2, r3] = pick_three_others(random, n, target);
      EXPECT_EQ((std::set<std::size_t>{target, r1, r2, r3}.size()), 4u);
      EXPECT_LT(std::max({r1, r2, r3}), n);
    }
  }
}

TEST(MutationRand1, SmallerAndLargerAreMinimumAndMaximum) {
  for (std::size_t const a : {0u, 1u, 7u, 99999u}) {
    for (std::size_t const b : {0u, 1u, 7u, 99999u}) {
      EXPECT_EQ(smaller(a, b), std::min(a, b));
      EXPECT_EQ(larger(a, b), std::max(a, b));
    }
  }
}

TEST(MutationRand1, PicksEveryOrderedTripleEquallyOften) {
  // 5 members without the target: 24 ordered triples
  constexpr int draws = 24000;
  std::map<std::array<std::size_t, 3>, int> counts;
  for (std::uint32_t draw = 0; draw < draws; ++draw) {
    RandomStream random({2, 0, RandomDomain::test}, draw, 0);
    ++counts[pick_three_others(random, 5, 2)];
  }
  ASSERT_EQ(counts.size(), 24u);
  // chi-square with 23 degrees of freedom exceeds 49.7 once in 1000
  double chi_square = 0.0;
  for (auto const& [triple, count] : counts) chi_square += (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_LT(chi_square, 49.7);
}

TEST(MutationRand1, AddsTheScaledDifferenceToTheBase) {
  Population population(4, 2);
  population.numbers = {9.0, 9.0, 1.0, 2.0, 5.0, 7.0, 3.0, 1.0};
  std::array<double, 2> mutant{};
  mutate_rand_1(population.members(), {1, 2, 3}, 0.5, mutant);
  EXPECT_EQ(mutant[0], 1.0 + 0.5 * (5.0 - 3.0));
  EXPECT_EQ(mutant[1], 2.0 + 0.5 * (7.0 - 1.0));
  mutate_rand_1(population.members(), {1, 2, 3}, 0.0, mutant);
  EXPECT_EQ(mutant, (std::array{1.0, 2.0}));
}

}  // namespace mutation_test
}  // namespace torquescope
