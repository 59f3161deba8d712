// The behaviour of FADE's fuzzy controllers in closed loop with a population that moves by PC = FC = c: three digits,
// computed independently (a Python prototype on 100001 points) before this code was written.

#include <gtest/gtest.h>

#include "engine/fit/optim/fuzzy_controller.hpp"

namespace torquescope {
namespace {

struct Row {
  double c;
  double F_centroid_1, F_centroid_2, CR_centroid;  // F in [0, 1] and in [0, 2]
  double F_average, CR_average;
};

constexpr Row table[] = {
    {0.0, 0.444, 0.624, 0.450, 0.396, 0.471},
    {1.0, 0.500, 0.759, 0.527, 0.505, 0.605},
    {2.0, 0.528, 0.824, 0.595, 0.703, 0.832},
    {50.0, 0.606, 0.923, 0.681, 0.861, 0.974},
};

constexpr double three_digits = 0.5e-3;

TEST(FadeControllers, FollowTheTableWithCentroid) {
  for (auto const how : {Defuzzification::centroid, Defuzzification::centroid_closed}) {
    FuzzyController const narrow({.F_universe = 1.0, .defuzzification = how});
    FuzzyController const wide({.F_universe = 2.0, .defuzzification = how});
    for (auto const& row : table) {
      EXPECT_NEAR(narrow(row.c, row.c).F, row.F_centroid_1, three_digits) << row.c;
      EXPECT_NEAR(wide(row.c, row.c).F, row.F_centroid_2, three_digits) << row.c;
      EXPECT_NEAR(wide(row.c, row.c).CR, row.CR_centroid, three_digits) << row.c;
      EXPECT_EQ(narrow(row.c, row.c).CR, wide(row.c, row.c).CR);
    }
  }
}

// the height method over the three clipped sets; over the nine rules it would be 0.442 and 0.552 at rest
TEST(FadeControllers, FollowTheTableWithWeightedAverage) {
  for (double const universe : {1.0, 2.0}) {
    FuzzyController const controller({.F_universe = universe, .defuzzification = Defuzzification::weighted_average});
    for (auto const& row : table) {
      EXPECT_NEAR(controller(row.c, row.c).F, row.F_average, three_digits) << row.c;
      EXPECT_NEAR(controller(row.c, row.c).CR, row.CR_average, three_digits) << row.c;
    }
  }
}

TEST(FadeControllers, GridAndClosedCentroidAgreeWhereverTheyAreUsed) {
  for (auto const pairing : {Pairing::original, Pairing::literal, Pairing::eq9}) {
    for (double const universe : {1.0, 2.0}) {
      FuzzyController const grid({.pairing = pairing, .F_universe = universe});
      FuzzyController const closed(
          {.pairing = pairing, .F_universe = universe, .defuzzification = Defuzzification::centroid_closed});
      for (double PC = 0.0; PC < 10.0; PC += 0.37) {
        for (double FC = 0.0; FC < 10.0; FC += 0.41) {
          EXPECT_NEAR(grid(PC, FC).F, closed(PC, FC).F, 2e-6);
          EXPECT_NEAR(grid(PC, FC).CR, closed(PC, FC).CR, 2e-6);
        }
      }
    }
  }
}

}  // namespace
}  // namespace torquescope
