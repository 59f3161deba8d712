#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/optimise.hpp"

namespace torquescope {
namespace jde_test {

using testing::ask;
using testing::bumpy;
using testing::make_optimiser;
using testing::members_of;
using testing::run_to_generation;

Bounds const box = testing::cube(3, -2.0, 2.0);
RandomKey const key{5, 1};

std::string const carried = "F, CR of members";

// generations written out plainly: what is asked, and which controls each member carries then
TEST(Jde, TakesTheStepsOfThePaper) {
  constexpr std::size_t N = 8, D = 3;
  auto const search = make_optimiser("jde", box, key, {{"population", std::int64_t{N}}});
  run_to_generation(*search, bumpy, 0);
  std::vector<double> F(N, 0.5), CR(N, 0.9);
  std::size_t n_renewed = 0, n_successes = 0;
  for (std::uint32_t generation = 1; generation <= 6; ++generation) {
    auto const x = search->population();
    auto batch = ask(*search);
    auto next_F = F, next_CR = CR;
    std::vector<bool> wins(N);
    double mean_F = 0.0, mean_CR = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
      RandomStream random(key, generation, static_cast<std::uint32_t>(i));
      double const u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform(), u4 = random.uniform();
      next_F[i] = u2 < 0.1 ? 0.1 + u1 * 0.9 : F[i];
      next_CR[i] = u4 < 0.1 ? u3 : CR[i];
      n_renewed += (u2 < 0.1 ? 1 : 0) + (u4 < 0.1 ? 1 : 0);
      mean_F += next_F[i] / N;
      mean_CR += next_CR[i] / N;
      std::vector<std::size_t> left;
      for (std::size_t other = 0; other < N; ++other)
        if (other != i) left.push_back(other);
      std::size_t r[3];
      for (std::size_t& one : r) {
        auto const at = left.begin() + random.below(static_cast<std::uint32_t>(left.size()));
        one = *at;
        left.erase(at);
      }
      std::size_t const j_rand = random.below(D);
      for (std::size_t j = 0; j < D; ++j) {
        double u = x(i, j);
        if (random.uniform() < next_CR[i] || j == j_rand) u = x(r[0], j) + next_F[i] * (x(r[1], j) - x(r[2], j));
        if (u > 2.0) u = 0.5 * (x(i, j) + 2.0);
        if (u < -2.0) u = 0.5 * (x(i, j) - 2.0);
        EXPECT_NEAR(batch.rows()(i, j), u, 1e-15) << generation << ", " << i;
      }
      batch.fitness[i] = bumpy(batch.rows().row(i));
      wins[i] = batch.fitness[i] <= search->fitness()[i];
    }
    search->tell(batch.rows(), batch.fitness);
    EXPECT_NEAR(search->progress().F, mean_F, 1e-15);
    EXPECT_NEAR(search->progress().CR, mean_CR, 1e-15);
    std::vector<double> expected;
    for (std::size_t i = 0; i < N; ++i) {
      if (wins[i]) {
        F[i] = next_F[i];
        CR[i] = next_CR[i];
        ++n_successes;
      }
      expected.insert(expected.end(), {F[i], CR[i]});
    }
    EXPECT_EQ(search->save().at(carried), expected);
  }
  EXPECT_GT(n_renewed, 3u);
  EXPECT_GT(n_successes, 5u);
}

// nothing wins on a function that only rises: what members carry stays, what trials try does not
TEST(Jde, ControlsLiveOnWithWinnersOnly) {
  auto const search = make_optimiser("jde", box, key);
  double rising = 0.0;
  run_to_generation(
      *search, [&](auto) { return rising += 1.0; }, 5);
  auto const numbers = search->save().at(carried);
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    EXPECT_EQ(numbers[i], 0.5);
    EXPECT_EQ(numbers[i + 1], 0.9);
  }
  EXPECT_NE(search->progress().F, 0.5);
}

// every trial of a flat function wins: with tau = 1 controls are new in every generation, uniform in their ranges
TEST(Jde, NewControlsAreUniformInTheirRanges) {
  auto const search =
      make_optimiser("jde", box, key, {{"population", std::int64_t{20000}}, {"tau_F", 1.0}, {"tau_CR", 1.0}});
  run_to_generation(
      *search, [](auto) { return 0.0; }, 1);
  auto const numbers = search->save().at(carried);
  std::vector<double> F, CR;
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    F.push_back(numbers[i]);
    CR.push_back(numbers[i + 1]);
  }
  for (auto* one : {&F, &CR}) std::sort(one->begin(), one->end());
  // Kolmogorov-Smirnov at 1e-3: 1.95 / sqrt(20000) = 0.0138
  for (std::size_t i = 0; i < F.size(); ++i) {
    double const share = static_cast<double>(i) / static_cast<double>(F.size());
    ASSERT_NEAR((F[i] - 0.1) / 0.9, share, 0.0138);
    ASSERT_NEAR(CR[i], share, 0.0138);
  }
}

TEST(Jde, EachOptionChangesTheSearch) {
  auto const best_after = [](std::vector<Setting> settings) {
    auto const search = make_optimiser("jde", box, key, std::move(settings));
    run_to_generation(*search, bumpy, 20);
    return search->progress().best;
  };
  auto const reference = best_after({});
  std::vector<Setting> const settings{
      {"population", std::int64_t{12}}, {"tau_F", 0.5}, {"tau_CR", 0.5}, {"F_first", 0.8}, {"CR_first", 0.2},
      {"repair", std::string("clip")}};
  for (auto const& setting : settings) EXPECT_NE(best_after({setting}), reference) << setting.key;
}

}  // namespace jde_test
}  // namespace torquescope
