// Least squares whose coefficients may not leave their bounds.

#include "engine/fit/statistics/scaled_solution.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace torquescope {
namespace scaled_solution_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

Eigen::MatrixXd drawn(std::uint64_t seed, Eigen::Index rows, Eigen::Index cols) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); });
}

// columns that say nearly the same, of very different size
Eigen::MatrixXd columns() {
  Eigen::MatrixXd all = drawn(1, 300, 4);
  all.col(1) += 5.0 * all.col(0);
  all.col(2) += 3.0 * all.col(1);
  all.col(3) *= 1e6;
  return all;
}

TEST(BoundedSolution, IsThePlainOneWhereNothingBinds) {
  Eigen::MatrixXd const signals = drawn(2, 300, 5);
  CoefficientBounds const wide{Eigen::VectorXd::Constant(4, -1e3), Eigen::VectorXd::Constant(4, infinity)};
  EXPECT_EQ(solve_scaled(columns(), signals, wide), solve_scaled(columns(), signals));
}

// the signs of the slope of the squares tell the least ones (Karush, Kuhn, Tucker)
TEST(BoundedSolution, LeavesNoSlopeToGoDownInside) {
  Eigen::MatrixXd const all = columns(), signals = drawn(3, 300, 200);
  CoefficientBounds const bounds{Eigen::Vector4d(-infinity, -0.01, -0.005, 0.0),
                                 Eigen::Vector4d(infinity, 0.02, 0.005, 1e-8)};
  Eigen::MatrixXd const found = solve_scaled(all, signals, bounds);
  Eigen::MatrixXd const slope =
      all.colwise().norm().cwiseInverse().asDiagonal() * (all.transpose() * (signals - all * found));
  int held = 0;
  for (Eigen::Index i = 0; i < signals.cols(); ++i)
    for (Eigen::Index k = 0; k < 4; ++k) {
      double const value = found(k, i);
      ASSERT_GE(value, bounds.lower[k]);
      ASSERT_LE(value, bounds.upper[k]);
      constexpr double rounding = 1e-8;
      EXPECT_TRUE(value == bounds.lower[k] || slope(k, i) > -rounding);
      EXPECT_TRUE(value == bounds.upper[k] || slope(k, i) < rounding);
      held += value == bounds.lower[k] || value == bounds.upper[k];
    }
  EXPECT_GT(held, 200);
}

// what cannot be moves nothing else: a coefficient that is held at 0 is as good as left out
TEST(BoundedSolution, OfAHeldCoefficientIsThatWithoutItsColumn) {
  Eigen::MatrixXd const all = columns(), signals = drawn(4, 300, 3);
  CoefficientBounds bounds{Eigen::VectorXd::Constant(4, -infinity), Eigen::VectorXd::Constant(4, infinity)};
  bounds.lower[3] = bounds.upper[3] = 0.0;
  Eigen::MatrixXd const found = solve_scaled(all, signals, bounds);
  EXPECT_TRUE(found.topRows(3).isApprox(solve_scaled(all.leftCols(3), signals), 1e-10));
  EXPECT_TRUE((found.row(3).array() == 0.0).all());
}

}  // namespace scaled_solution_test
}  // namespace torquescope
