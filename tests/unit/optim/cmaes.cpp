#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "support/optimise.hpp"

namespace torquescope {
namespace cmaes_test {

using testing::ask;
using testing::make_optimiser;
using testing::run_to_generation;

Bounds const box = testing::cube(3, -2.0, 2.0);
RandomKey const key{5, 1};

double ellipsoid(std::array<double, 3> const& y) { return y[0] * y[0] + 1e2 * y[1] * y[1] + 1e4 * y[2] * y[2]; }

double straight(std::span<double const> x) { return ellipsoid({x[0] - 0.3, x[1] + 0.2, x[2] - 0.1}); }

// the same about the same point, with its axes turned: (1, 1, 1), (1, -1, 0), (1, 1, -2)
double turned(std::span<double const> x) {
  double const a = x[0] - 0.3, b = x[1] + 0.2, c = x[2] - 0.1;
  return ellipsoid({(a + b + c) / std::sqrt(3.0), (a - b) / std::sqrt(2.0), (a + b - 2.0 * c) / std::sqrt(6.0)});
}

double median_generations(testing::Fitness const& fitness, double target) {
  std::vector<double> needed;
  for (std::uint32_t run = 0; run < 15; ++run) {
    auto const search = make_optimiser("cmaes", box, {5, run});
    run_to_generation(*search, fitness, 0);
    while (search->progress().best_fitness > target && search->progress().generation < 2000)
      run_to_generation(*search, fitness, search->progress().generation + 1);
    needed.push_back(static_cast<double>(search->progress().generation));
  }
  std::sort(needed.begin(), needed.end());
  return needed[7];
}

// only the order counts: every candidate keeps its bits
TEST(Cmaes, AsksTheSameForEveryIncreasingFunctionOfFitness) {
  auto const candidates_after = [](testing::Fitness const& fitness) {
    auto const search = make_optimiser("cmaes", box, key);
    run_to_generation(*search, fitness, 60);
    return ask(*search).numbers;
  };
  auto const reference = candidates_after(turned);
  EXPECT_EQ(candidates_after([](auto x) { return 1e-7 * turned(x); }), reference);
  EXPECT_EQ(candidates_after([](auto x) { return std::sqrt(turned(x)); }), reference);
  EXPECT_EQ(candidates_after([](auto x) { return std::log(turned(x)); }), reference);
}

// a condition of 1e4 costs what learning it costs, in whatever direction its axes point
TEST(Cmaes, TurningTheAxesDoesNotMatterMuch) {
  double const along = median_generations(straight, 1e-12);
  double const across = median_generations(turned, 1e-12);
  EXPECT_LT(along, 300.0);
  EXPECT_LT(across, 1.25 * along);
  EXPECT_GT(across, 0.8 * along);
}

TEST(Cmaes, FindsAMinimumInACornerOfTheBox) {
  Bounds const cube = testing::cube(8, 0.0, 1.0);
  auto const distance = [](std::span<double const> x) {
    double sum = 0.0;
    for (double const v : x) sum += v;
    return sum;
  };
  auto const search = make_optimiser("cmaes", cube, key);
  run_to_generation(*search, distance, 300);
  EXPECT_LT(search->progress().best_fitness, 1e-6);
}

// it learns from mirrored samples, so no image beyond a bound draws it out
TEST(Cmaes, MeanStaysInTheBox) {
  auto const search = make_optimiser("cmaes", box, key);
  for (std::int64_t generation = 0; generation < 100; ++generation) {
    run_to_generation(
        *search, [](auto x) { return (x[0] - 1.9) * (x[0] - 1.9) - x[1] + x[2] * x[2]; }, generation);
    auto const distribution = search->save().at("distribution");
    for (std::size_t j = 0; j < 3; ++j) {
      ASSERT_GE(distribution[j], 0.0);
      ASSERT_LE(distribution[j], 1.0);
    }
  }
  EXPECT_LT(search->progress().best_fitness, -2.0 + 1e-4);
}

TEST(Cmaes, BeginsAnewWhereItHasCollapsed) {
  // a wide basin, and a narrow one that is deeper: from most starts only later ones can find it
  auto const two_basins = [](std::span<double const> x) {
    double wide = 0.0, narrow = 0.0;
    for (double const v : x) {
      wide += (v - 0.8) * (v - 0.8);
      narrow += (v + 1.2) * (v + 1.2);
    }
    return std::min(wide, 6.0 * narrow - 1.0);
  };
  int first_start = 0, in_the_end = 0;
  for (std::uint32_t run = 0; run < 10; ++run) {
    // larger samples would see the wide one ever more surely
    auto const search = make_optimiser("cmaes", box, {5, run}, {{"restarts", std::string("same")}});
    run_to_generation(*search, two_basins, 60);
    first_start += search->progress().best_fitness < -0.5 ? 1 : 0;
    for (std::int64_t last = 500; last <= 12000 && search->progress().best_fitness > -0.5; last += 500)
      run_to_generation(*search, two_basins, last);
    in_the_end += search->progress().best_fitness < -0.5 ? 1 : 0;
  }
  EXPECT_LT(first_start, 10);
  EXPECT_EQ(in_the_end, 10);
}

// many minima: restarts come soon, and generations of several batches with them
TEST(Cmaes, GoesOnFromTheMiddleOfALargeGeneration) {
  for (std::string const restarts : {"ipop", "bipop", "same"}) {
    std::vector<Setting> const settings{{"restarts", restarts}};
    auto const whole = make_optimiser("cmaes", box, key, settings);
    auto resumed = make_optimiser("cmaes", box, key, settings);
    bool was_in_the_middle = false, had_begun_anew = false;
    for (std::int64_t generation = 0; generation <= 1500; ++generation) {
      run_to_generation(*whole, testing::bumpy, generation);
      run_to_generation(*resumed, testing::bumpy, generation);
      ASSERT_EQ(ask(*resumed).numbers, ask(*whole).numbers) << restarts << ", " << generation;
      auto const state = resumed->save();
      was_in_the_middle |= !state.at("told").empty();
      had_begun_anew |= state.at("start history").front() < static_cast<double>(generation) / 4.0;
      if (generation % 7 != 0) continue;
      resumed = make_optimiser("cmaes", box, key, settings);
      resumed->restore(state);
    }
    EXPECT_EQ(was_in_the_middle, restarts != "same");
    EXPECT_TRUE(had_begun_anew) << restarts;
    EXPECT_EQ(whole->batch_size(), whole->largest_batch());
  }
}

TEST(Cmaes, EachOptionChangesTheSearch) {
  auto const best_after = [](std::vector<Setting> settings) {
    auto const search = make_optimiser("cmaes", box, key, std::move(settings));
    run_to_generation(*search, turned, 10);
    return search->progress().best;
  };
  auto const reference = best_after({});
  EXPECT_NE(best_after({{"population", std::int64_t{12}}}), reference);
  EXPECT_NE(best_after({{"sigma", 0.1}}), reference);
}

}  // namespace cmaes_test
}  // namespace torquescope
