#include "engine/fit/optim/defuzzification.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace defuzzification_test {

FuzzyVariable const F_narrow{"F", 1.0, 0.5, {0.3, 0.6, 0.9}};
FuzzyVariable const F_wide{"F", 2.0, 0.5, {0.3, 0.6, 0.9}};
FuzzyVariable const CR{"CR", 1.0, 0.35, {0.4, 0.7, 1.0}};

// the kinks of a clipped set cost a trapezoid of width h at most about h^2; h = 2 / 1000
constexpr double grid_error = 2e-6;

TEST(Centroid, OfAFullRectangleIsItsMiddle) {
  // so low a level that every set is clipped over the whole universe
  EXPECT_NEAR(closed_centroid(F_narrow, {1e-3, 1e-3, 1e-3}), 0.5, 1e-15);
  EXPECT_NEAR(GridCentroid(F_narrow, 1001)({1e-3, 1e-3, 1e-3}), 0.5, 1e-13);
}

TEST(Centroid, OfASymmetricSetIsItsMean) {
  FuzzyVariable const symmetric{"y", 1.0, 0.1, {-5.0, 0.5, 6.0}};
  for (double const level : {0.01, 0.5, 1.0}) {
    EXPECT_NEAR(closed_centroid(symmetric, {0.0, level, 0.0}), 0.5, 1e-14);
    EXPECT_NEAR(GridCentroid(symmetric, 1001)({0.0, level, 0.0}), 0.5, 1e-13);
  }
}

TEST(Centroid, GridAgreesWithTheClosedForm) {
  for (auto const* output : {&F_narrow, &F_wide, &CR}) {
    GridCentroid const on_grid(*output, 1001);
    for (std::uint32_t draw = 0; draw < 2000; ++draw) {
      RandomStream random({8, 0, RandomDomain::test}, draw, 0);
      SetLevels const levels{random.uniform(), random.uniform(), random.uniform()};
      EXPECT_NEAR(on_grid(levels), closed_centroid(*output, levels), grid_error);
    }
  }
}

TEST(Centroid, GridConvergesQuadratically) {
  SetLevels const levels{0.9, 0.3, 0.05};
  double const exact = closed_centroid(F_wide, levels);
  EXPECT_LT(std::fabs(GridCentroid(F_wide, 100001)(levels) - exact), 1e-9);
  EXPECT_LT(std::fabs(GridCentroid(F_wide, 101)(levels) - exact), 2e-4);
}

TEST(Centroid, LevelsOfZeroAndOneAreHandled) {
  GridCentroid const on_grid(CR, 1001);
  for (SetLevels const levels : {SetLevels{1.0, 1.0, 1.0}, SetLevels{1.0, 0.0, 0.0}, SetLevels{0.0, 0.0, 1.0}}) {
    EXPECT_NEAR(on_grid(levels), closed_centroid(CR, levels), grid_error);
  }
}

TEST(WeightedAverage, LiesBetweenTheMeansOfTheFiringSets) {
  EXPECT_DOUBLE_EQ(weighted_average(CR, {0.7, 0.0, 0.0}), 0.4);
  EXPECT_DOUBLE_EQ(weighted_average(CR, {0.0, 0.0, 0.2}), 1.0);
  EXPECT_DOUBLE_EQ(weighted_average(CR, {0.5, 0.0, 0.5}), 0.7);
}

}  // namespace defuzzification_test
}  // namespace torquescope
