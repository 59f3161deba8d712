// One wrong sample moves a parameter as a fit without it says; no row of noise does, also of correlated noise.

#include "engine/fit/problem/row_influence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "engine/fit/problem/least_squares.hpp"
#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace row_influence_test {

Eigen::VectorXd fitted(RegressionData const& data) { return solve_weighted(data, {}); }

TEST(RowInfluence, OfAWrongSampleIsItsChange) {
  constexpr Eigen::Index half_width = 5, wrong = 1234;
  auto data = test::seed_data(30.0, 0.01);
  // as a filter spreads it
  for (Eigen::Index k = -2; k <= 2; ++k) data.tau[wrong + k] += 1.0 - 0.3 * static_cast<double>(std::abs(k));
  auto const found = RowInfluences(data, fitted(data), half_width).of(wrong);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_GT(found[1].errors, 1.0);

  RegressionData without = data;
  without.phi.middleRows(wrong - half_width, 2 * half_width + 1).setZero();
  without.tau.segment(wrong - half_width, 2 * half_width + 1).setZero();
  Eigen::VectorXd const value = fitted(without), change = fitted(data) - value;
  for (auto const& one : found) {
    EXPECT_NEAR(one.without, value[one.parameter], 1e-9 * std::fabs(value[one.parameter]));
    EXPECT_NEAR(one.change, change[one.parameter], 1e-7 * std::fabs(change[one.parameter]));
  }
}

TEST(RowInfluence, IsSmallOfNoise) {
  for (std::uint32_t run = 0; run < 3; ++run)
    for (double correlation : {0.0, 0.8}) {
      auto const data = test::seed_data(30.0, test::autoregressive_noise(3000, run, 0.05, correlation));
      RowInfluences const influences(data, fitted(data), 5);
      for (Eigen::Index row = 0; row < data.rows(); row += 20) {
        for (auto const& one : influences.of(row))
          EXPECT_LT(one.errors, 0.7) << run << " " << correlation << " " << row << " " << one.parameter;
      }
    }
}

TEST(RowInfluence, IsNotAskedOfAFewRows) {
  auto const data = test::seed_data(1.0, 0.01);
  EXPECT_TRUE(RowInfluences(data, fitted(data), 5).of(50).empty());
}

}  // namespace row_influence_test
}  // namespace torquescope
