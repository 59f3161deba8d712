#include <gtest/gtest.h>

#include <cmath>

#include "engine/fit/optim/fuzzy_controller.hpp"
#include "support/optimise.hpp"

namespace torquescope {
namespace fade_test {

using testing::make_optimiser;
using testing::run_to_generation;

RandomKey const key{5, 1};
Bounds const box = testing::cube(3, -2.0, 2.0);

double bumpy(std::span<double const> x) {
  double sum = 0.0;
  for (double const v : x) sum += v * v + 0.3 * std::cos(7.0 * v);
  return sum;
}

TEST(Fade, TakesTheFirstControlsThenTheControllers) {
  auto const search = make_optimiser("fade", box, key);
  FuzzyController const controller({});
  run_to_generation(*search, bumpy, 1);
  EXPECT_EQ(search->progress().F, 0.5);
  EXPECT_EQ(search->progress().CR, 0.9);
  for (std::int64_t generation = 2; generation <= 20; ++generation) {
    auto const [F, CR] = controller(search->progress().PC, search->progress().FC);
    run_to_generation(*search, bumpy, generation);
    EXPECT_EQ(search->progress().F, F);
    EXPECT_EQ(search->progress().CR, CR);
  }
}

TEST(Fade, EachOptionChangesTheSearch) {
  auto const best_after = [](std::vector<Setting> settings) {
    auto const search = make_optimiser("fade", box, key, std::move(settings));
    run_to_generation(*search, bumpy, 15);
    return search->progress().best;
  };
  auto const reference = best_after({});
  std::vector<Setting> const settings{{"population", std::int64_t{12}},
                                      {"pairing", std::string("literal")},
                                      {"pairing", std::string("eq9")},
                                      {"F_universe", 1.0},
                                      {"d12_small_mean", 0.01},
                                      {"defuzzification", std::string("weighted_average")},
                                      {"defuzzification", std::string("centroid_closed")},
                                      {"centroid_points", std::int64_t{101}},
                                      {"norm", std::string("relative")},
                                      {"F_first", 0.8},
                                      {"CR_first", 0.3},
                                      {"repair", std::string("reflect")}};
  for (auto const& setting : settings) EXPECT_NE(best_after({setting}), reference) << setting.key;
}

// x and f scaled by powers of two: every comparison, every PC, FC, F and CR keeps its bits
TEST(Fade, WithRelativeNormIgnoresScaleOfFitnessAndOfTheBox) {
  std::vector<Setting> const relative{{"norm", std::string("relative")}};
  auto const plain = make_optimiser("fade", box, key, relative);
  run_to_generation(*plain, bumpy, 60);
  for (double const x_scale : {0x1p-20, 1.0, 0x1p9}) {
    for (double const f_scale : {0x1p-100, 1.0, 0x1p33}) {
      auto const scaled = make_optimiser("fade", testing::cube(3, -2.0 * x_scale, 2.0 * x_scale), key, relative);
      auto const fitness = [&](auto x) {
        return f_scale * bumpy(std::vector{x[0] / x_scale, x[1] / x_scale, x[2] / x_scale});
      };
      run_to_generation(*scaled, fitness, 60);
      EXPECT_EQ(scaled->progress().F, plain->progress().F);
      EXPECT_EQ(scaled->progress().CR, plain->progress().CR);
      EXPECT_EQ(scaled->progress().PC, plain->progress().PC);
      EXPECT_EQ(scaled->progress().FC, plain->progress().FC);
      EXPECT_EQ(scaled->progress().best_fitness, f_scale * plain->progress().best_fitness);
      for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(scaled->progress().best[j], x_scale * plain->progress().best[j]);
    }
  }
}

// the counterpart: as printed in the paper, the method depends on the unit of fitness
TEST(Fade, WithRawNormDependsOnTheScaleOfFitness) {
  auto const plain = make_optimiser("fade", box, key);
  auto const scaled = make_optimiser("fade", box, key);
  run_to_generation(*plain, bumpy, 10);
  run_to_generation(
      *scaled, [](auto x) { return 0x1p20 * bumpy(x); }, 10);
  EXPECT_GT(scaled->progress().F, plain->progress().F + 0.05);
}

}  // namespace fade_test
}  // namespace torquescope
