#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/fit/optim/trial_vector.hpp"
#include "support/optimise.hpp"

namespace torquescope {
namespace de_test {

using testing::bumpy;
using testing::make_optimiser;
using testing::members_of;
using testing::run_to_generation;

Bounds const box = testing::cube(3, -2.0, 2.0);
RandomKey const key{5, 1};

std::vector<double> population_after(testing::Fitness const& fitness, std::int64_t generations) {
  auto const search = make_optimiser("de", box, key);
  run_to_generation(*search, fitness, generations);
  return members_of(*search);
}

TEST(De, TrajectoryIgnoresScaleAndOffsetOfFitness) {
  auto const reference = population_after(bumpy, 50);
  EXPECT_EQ(population_after([](auto x) { return 0x1p40 * bumpy(x); }, 50), reference);
  EXPECT_EQ(population_after([](auto x) { return 0x1p-300 * bumpy(x); }, 50), reference);
  EXPECT_EQ(population_after([](auto x) { return bumpy(x) + 4096.0; }, 50), reference);
  EXPECT_EQ(population_after([](auto x) { return bumpy(x) - 4096.0; }, 50), reference);
}

TEST(De, TrajectoryScalesWithTheBox) {
  for (std::string const repair : {"midpoint", "clip", "reflect", "random"}) {
    std::vector<Setting> const settings{{"repair", repair}};
    auto const plain = make_optimiser("de", box, key, settings);
    auto const scaled = make_optimiser("de", testing::cube(3, -0x1p21, 0x1p21), key, settings);
    run_to_generation(*plain, bumpy, 30);
    run_to_generation(
        *scaled,
        [](auto x) {
          return bumpy(std::vector{x[0] * 0x1p-20, x[1] * 0x1p-20, x[2] * 0x1p-20});
        },
        30);
    for (std::size_t i = 0; i < plain->population().rows(); ++i) {
      for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(scaled->population()(i, j), 0x1p20 * plain->population()(i, j));
    }
  }
}

// streams are computed ahead, for many members at once and up to some length: neither may be seen in a trial
TEST(De, MakesEveryTrialFromItsMembersOwnStream) {
  for (std::size_t const dimension : {std::size_t{1}, std::size_t{4}, std::size_t{201}}) {
    Bounds const bounds = testing::cube(dimension, -2.0, 2.0);
    auto const search = make_optimiser("de", bounds, key, {{"population", std::int64_t{301}}, {"repair", "random"}});
    run_to_generation(*search, bumpy, 2);
    auto trials = testing::ask(*search);
    std::vector<double> trial(dimension);
    for (std::size_t i = 0; i < 301; ++i) {
      RandomStream random(key, 3, static_cast<std::uint32_t>(i));
      make_rand_1_bin_trial(search->population(), i, {0.5, 0.9, BoundRepair::random}, bounds, random, trial);
      EXPECT_TRUE(std::equal(trial.begin(), trial.end(), trials.rows().row(i).begin()));
    }
  }
}

TEST(De, ReportsTheControlsOfTheJob) {
  auto const search = make_optimiser("de", box, key, {{"F", 0.7}, {"CR", 0.2}});
  run_to_generation(*search, bumpy, 4);
  EXPECT_EQ(search->progress().F, 0.7);
  EXPECT_EQ(search->progress().CR, 0.2);
  EXPECT_GT(search->progress().PC, 0.0);
}

TEST(De, HasMoreMembersInMoreParameters) {
  for (auto const& [dimension, members] : {std::pair{1, 30}, {3, 30}, {4, 40}, {60, 600}}) {
    auto const bounds = testing::cube(static_cast<std::size_t>(dimension), -1.0, 1.0);
    EXPECT_EQ(testing::make_optimiser("de", bounds, {1, 0})->batch_size(), static_cast<std::size_t>(members));
  }
}

}  // namespace de_test
}  // namespace torquescope
