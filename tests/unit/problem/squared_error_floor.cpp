#include "engine/fit/problem/squared_error_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace squared_error_floor_test {

TEST(SquaredErrorFloor, IsTheMseOfOls) {
  auto const data = test::seed_data(20.0, 0.3);
  SquaredErrorFloor const floor(data);
  auto const ols = test::fit("ols", data);
  EXPECT_EQ(floor.least_squares(), ols.parameters);
  EXPECT_EQ(floor.mse(), ols.metrics.mse);
}

TEST(Gap, IsTheDifferenceOfMeanSquaredErrors) {
  auto const data = test::seed_data(20.0, 0.3);
  SquaredErrorFloor const floor(data);
  RandomStream random({5, 0, RandomDomain::test}, 0, 0);
  for (int m = 0; m < 20; ++m) {
    Eigen::Vector4d candidate;
    for (auto& x : candidate) x = random.uniform(-1.0, 1.0);
    double const mse = prediction_metrics(data, candidate).mse, gap = floor.gap({candidate.data(), 4});
    EXPECT_GE(gap, 0.0);
    EXPECT_NEAR(gap, mse - floor.mse(), 1e-12 * mse);
  }
}

TEST(Gap, KeepsItsDigitsWhereADifferenceHasNone) {
  // a step h along one axis: gap = h^2 |phi_r|^2 / n, down to 1e-30 of the MSE
  auto const data = test::seed_data(20.0, 0.3);
  SquaredErrorFloor const floor(data);
  std::vector<double> candidate(floor.least_squares().begin(), floor.least_squares().end());
  EXPECT_EQ(floor.gap(candidate), 0.0);
  candidate[2] += 0x1p-48;
  double const step = candidate[2] - floor.least_squares()[2];  // what is left of it after rounding
  double const expected = step * step * data.phi.col(2).squaredNorm() / 2000.0;
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(floor.gap(candidate) / expected, 1.0, 1e-12);
}

TEST(Gap, OfACandidateThatIsNoNumberIsNone) {
  SquaredErrorFloor const floor(test::seed_data(5.0, 0.3));
  double const candidate[] = {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};
  EXPECT_TRUE(std::isnan(floor.gap(candidate)));
}

}  // namespace squared_error_floor_test
}  // namespace torquescope
