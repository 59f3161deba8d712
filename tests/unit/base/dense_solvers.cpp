#include "engine/base/dense_solvers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace torquescope {
namespace dense_solvers_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// the same numbers every time, as if by chance
MatrixXd scattered(Eigen::Index rows, Eigen::Index columns) {
  MatrixXd all(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i) {
      auto const place = static_cast<double>(columns * i + j);
      all(i, j) = std::sin(12.9898 * (place + 1.0) * (place + 0.5));
    }
  return all;
}

// solve_positive() and solve_pivoted() are Eigen's own solvers: a kept factor gives their bits
TEST(DenseSolvers, KeptFactorsGiveTheBitsOfEigen) {
  MatrixXd const columns = scattered(40, 7), square = columns.transpose() * columns, several = scattered(7, 3);
  VectorXd const one = scattered(7, 1), long_one = scattered(40, 1);
  EXPECT_EQ(cholesky_of(square)->solve(one), solve_positive(square, one));
  EXPECT_EQ(cholesky_of(square)->solve(several), solve_positive(square, several));
  EXPECT_EQ(PivotedQr(columns, 1e-12).solve(long_one), solve_pivoted(columns, long_one));
}

TEST(DenseSolvers, SolutionsGiveTheRightSideBack) {
  MatrixXd const columns = scattered(40, 7), square = columns.transpose() * columns, several = scattered(7, 3);
  VectorXd const one = several.col(1);
  for (MatrixXd const& found : {solve_positive(square, several), solve_semidefinite(square, several)})
    EXPECT_LT((square * found - several).norm(), 1e-12 * several.norm());
  for (VectorXd const& found : {solve_positive(square, one), solve_semidefinite(square, one)})
    EXPECT_LT((square * found - one).norm(), 1e-12 * one.norm());
}

// of rank 4, with a right side in the range
TEST(DenseSolvers, SemidefiniteMatricesAreSolvedInTheirRange) {
  MatrixXd const columns = scattered(4, 7), square = columns.transpose() * columns;
  MatrixXd const several = square * scattered(7, 3);
  VectorXd const one = several.col(0);
  EXPECT_LT((square * solve_semidefinite(square, several) - several).norm(), 1e-12 * several.norm());
  EXPECT_LT((square * solve_semidefinite(square, one) - one).norm(), 1e-12 * one.norm());
}

TEST(DenseSolvers, LeastSquaresLeaveNothingAlongTheColumns) {
  MatrixXd columns = scattered(40, 7);
  MatrixXd const several = scattered(40, 3);
  VectorXd const one = several.col(2);
  for (bool const is_dependent : {false, true}) {
    if (is_dependent) columns.col(5) = columns.col(1) + 3.0 * columns.col(2);
    VectorXd const pivoted = solve_pivoted(columns, one), shortest = solve_shortest(columns, one);
    MatrixXd const each = solve_shortest(columns, several);
    for (VectorXd const& found : {pivoted, shortest, VectorXd(each.col(2))})
      EXPECT_LT((columns.transpose() * (one - columns * found)).norm(), 1e-12 * columns.norm() * one.norm());
    EXPECT_LT((columns.transpose() * (several - columns * each)).norm(), 1e-12 * columns.norm() * several.norm());
    if (!is_dependent) {
      EXPECT_LT((pivoted - shortest).norm(), 1e-12 * shortest.norm());
      continue;
    }
    EXPECT_EQ((pivoted.array() == 0.0).count(), 1);
    // the shortest has no part along what the columns send to 0
    VectorXd none = VectorXd::Zero(7);
    none[1] = 1.0;
    none[2] = 3.0;
    none[5] = -1.0;
    EXPECT_LT(std::fabs(none.dot(shortest)), 1e-12 * shortest.norm());
    EXPECT_LT((none.transpose() * each).norm(), 1e-12 * each.norm());
  }
}

TEST(DenseSolvers, CholeskyFactorMultipliesToTheMatrix) {
  MatrixXd const columns = scattered(20, 5), square = columns.transpose() * columns;
  auto const factor = cholesky_of(square);
  ASSERT_TRUE(factor);
  MatrixXd const& lower = factor->lower();
  EXPECT_LT((lower * lower.transpose() - square).norm(), 1e-13 * square.norm());
  EXPECT_LT((lower * factor->solve_lower(square) - square).norm(), 1e-12 * square.norm());
  EXPECT_LT((lower.transpose() * factor->solve_upper(square) - square).norm(), 1e-12 * square.norm());
  EXPECT_FALSE(cholesky_of(-square));
}

TEST(DenseSolvers, TrianglesHoldTheProductsOfTheColumns) {
  MatrixXd const columns = scattered(30, 4), right = scattered(30, 2);
  MatrixXd const gram = columns.transpose() * columns, triangle = triangle_of(columns);
  EXPECT_LT((triangle.transpose() * triangle - gram).norm(), 1e-13 * gram.norm());
  auto const [r, q_right] = qr_factors(columns, right);
  EXPECT_EQ(r, triangle);
  EXPECT_LT((r.transpose() * q_right - columns.transpose() * right).norm(), 1e-12);
}

TEST(DenseSolvers, RowsAFewAtATimeGiveTheSameProducts) {
  for (Eigen::Index rows : {3, 5, 512, 513, 1700}) {  // fewer than columns, one piece, several
    MatrixXd const columns = scattered(rows, 4);
    VectorXd const right = scattered(rows, 1).col(0);
    auto const [r, q_right] = qr_factors_by_rows(columns, right);
    ASSERT_EQ(r.rows(), std::min<Eigen::Index>(rows, 4));
    EXPECT_TRUE(r.isUpperTriangular());
    EXPECT_LT((r.transpose() * r - columns.transpose() * columns).norm(), 1e-12 * columns.squaredNorm()) << rows;
    EXPECT_LT((r.transpose() * q_right - columns.transpose() * right).norm(), 1e-12 * columns.squaredNorm()) << rows;
  }
}

TEST(DenseSolvers, PivotingFindsTheRankAndASpanOfIt) {
  MatrixXd columns = scattered(30, 4);
  columns.col(2) = columns.col(0) - 2.0 * columns.col(3);
  PivotedQr const qr(columns, 1e-12);
  ASSERT_EQ(qr.rank(), 3);
  MatrixXd const basis = qr.basis();
  EXPECT_LT((basis.transpose() * basis - MatrixXd::Identity(3, 3)).norm(), 1e-13);
  EXPECT_LT((columns - basis * (basis.transpose() * columns)).norm(), 1e-12);
  EXPECT_LT((qr.projected(columns, 3) - columns).norm(), 1e-12);
  MatrixXd independent(30, 3);
  for (Eigen::Index k = 0; k < 3; ++k) independent.col(k) = columns.col(qr.order()[k]);
  MatrixXd const orthonormal = independent * qr.inverse_triangle();
  EXPECT_LT((orthonormal.transpose() * orthonormal - MatrixXd::Identity(3, 3)).norm(), 1e-12);
  EXPECT_EQ(basis_of(columns).cols(), 3);
}

TEST(DenseSolvers, AxesAndSingularValuesDescribeTheMatrix) {
  MatrixXd const columns = scattered(20, 4), gram = columns.transpose() * columns;
  auto const axes = symmetric_axes(gram);
  EXPECT_LT((axes.vectors * axes.values.asDiagonal() * axes.vectors.transpose() - gram).norm(), 1e-13 * gram.norm());
  EXPECT_LT((symmetric_eigenvalues(gram) - axes.values).norm(), 1e-13 * gram.norm());
  VectorXd const squares = axes.values.reverse();
  EXPECT_LT((singular_values(columns).cwiseAbs2() - squares).norm(), 1e-13 * gram.norm());
  MatrixXd const triangle = triangle_of(columns);
  EXPECT_LT((singular_values_of_square(triangle).cwiseAbs2() - squares).norm(), 1e-13 * gram.norm());
  auto const right = right_singular(triangle);
  EXPECT_LT((right.vectors * right.values.cwiseAbs2().asDiagonal() * right.vectors.transpose() - gram).norm(),
            1e-13 * gram.norm());
}

}  // namespace dense_solvers_test
}  // namespace torquescope
