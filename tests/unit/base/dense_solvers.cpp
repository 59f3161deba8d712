#include "engine/base/dense_solvers.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
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

TEST(DenseSolvers, GiveTheBitsOfEigenInPlace) {
  MatrixXd const columns = scattered(40, 7), square = columns.transpose() * columns, several = scattered(7, 3);
  VectorXd const one = scattered(7, 1), long_one = scattered(40, 1);
  EXPECT_EQ(solve_positive(square, one), VectorXd(square.llt().solve(one)));
  EXPECT_EQ(solve_positive(square, several), MatrixXd(square.llt().solve(several)));
  EXPECT_EQ(cholesky_of(square)->solve(one), VectorXd(square.llt().solve(one)));
  EXPECT_EQ(cholesky_of(square)->solve(several), MatrixXd(square.llt().solve(several)));
  EXPECT_EQ(solve_semidefinite(square, several), MatrixXd(square.ldlt().solve(several)));
  EXPECT_EQ(solve_pivoted(columns, long_one), VectorXd(columns.colPivHouseholderQr().solve(long_one)));
  EXPECT_EQ(solve_shortest(columns, long_one), VectorXd(columns.completeOrthogonalDecomposition().solve(long_one)));
  EXPECT_EQ(PivotedQr(columns, 1e-12).solve(long_one), solve_pivoted(columns, long_one));
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
