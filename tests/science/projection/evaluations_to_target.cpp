// Solving linear parameters inside a search of the shapes finds the same effect as a search in everything, with a
// fraction of its evaluations.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "science/projection/shape_race.hpp"

namespace torquescope::test {
namespace {

class Projection : public ::testing::TestWithParam<std::string> {
 protected:
  static CleanStage const& clean(std::uint32_t number) {
    static std::array<CleanStage, 3> const stages{CleanStage(0, 2), CleanStage(1, 2), CleanStage(2, 2)};
    return stages[number];
  }
  static constexpr std::uint32_t n_recordings = 3;
};

TEST_P(Projection, HasItsBestInsideTheFullBoxWithTheSameEnergy) {
  for (std::uint32_t number = 0; number < n_recordings; ++number) {
    PlantedMismatch const planted = planted_mismatch(clean(number), *find_effect(GetParam()));
    BestKnown const best = best_known(planted);
    FullEnergy const full(planted);
    std::vector<double> const candidate = full.best_at(best.shape);
    for (double const one : candidate) {
      EXPECT_GE(one, 0.0);
      EXPECT_LE(one, 1.0);
    }
    double energy = 0.0;
    Workspace workspace;
    full.evaluate({candidate.data(), 1, candidate.size()}, {&energy, 1}, workspace);
    constexpr double rounding = 1e-8;  // of sums over a thousand rows, through an orthonormal basis
    EXPECT_NEAR(energy / best.energy, 1.0, rounding);
    // the best explains at least as much as the truth
    EXPECT_LE(best.energy, ProjectedEnergy(planted).at(planted.shape));
  }
}

TEST_P(Projection, ReachesTheTargetWithAFractionOfTheEvaluations) {
  constexpr std::int64_t least_ratio = 10;  // measured: more than 100 (bench/README.md)
  for (std::uint32_t number = 0; number < n_recordings; ++number) {
    PlantedMismatch const planted = planted_mismatch(clean(number), *find_effect(GetParam()));
    double const target = (1.0 + target_excess) * best_known(planted).energy;
    for (std::string const optimiser : {"de", "fade"}) {
      RaceEnd const alone = race_as_diagnosed(planted, shape_search(optimiser, 1), target);
      ASSERT_TRUE(alone.reached) << optimiser << ", recording " << number;
      // the whole race to the target would only take longer
      RaceEnd const all =
          race(optimiser, 30, FullEnergy(planted), target, least_ratio * alone.evaluations, {1, number});
      EXPECT_FALSE(all.reached) << optimiser << ", recording " << number << ": " << all.evaluations << " against "
                                << alone.evaluations;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, Projection, ::testing::Values("presliding", "thermal_friction"),
                         [](auto const& one) { return one.param; });

}  // namespace
}  // namespace torquescope::test
