// Least squares from blocks of rows: as exact as from all rows at once, for every size of block.

#include "engine/fit/problem/row_reduction.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <numeric>
#include <vector>

#include "support/decompositions.hpp"
#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace row_reduction_test {

constexpr Eigen::Index block_sizes[] = {1, 3, 64, 501, 1999, 2000, 5000};

Eigen::VectorXd solve_in_blocks(RegressionData const& data, Eigen::Index block_rows) {
  auto const reduced = reduce_rows(data, {}, block_rows);
  return test::least_squares(reduced.phi, reduced.tau);
}

// modified Gram-Schmidt of [phi | tau] in long double: 11 bits more, and loops that take a compiler no time
Eigen::VectorXd solve_in_long_double(RegressionData const& data) {
  using Column = std::vector<long double>;
  auto const dot = [](Column const& a, Column const& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0L);
  };
  auto const R = static_cast<std::size_t>(data.phi.cols());
  std::vector<Column> columns;
  for (Eigen::Index k = 0; k < data.phi.cols(); ++k)
    columns.emplace_back(data.phi.col(k).begin(), data.phi.col(k).end());
  columns.emplace_back(data.tau.begin(), data.tau.end());
  std::vector<Column> r(R, Column(R + 1));
  for (std::size_t k = 0; k < R; ++k) {
    long double const square = dot(columns[k], columns[k]);
    for (std::size_t j = k + 1; j <= R; ++j) {
      r[k][j] = dot(columns[k], columns[j]) / square;
      for (std::size_t i = 0; i < columns[k].size(); ++i) columns[j][i] -= r[k][j] * columns[k][i];
    }
  }
  Eigen::VectorXd parameters(data.phi.cols());
  Column solved(R);
  for (std::size_t k = R; k-- > 0;) {
    solved[k] = r[k][R];
    for (std::size_t j = k + 1; j < R; ++j) solved[k] -= r[k][j] * solved[j];
    parameters[static_cast<Eigen::Index>(k)] = static_cast<double>(solved[k]);
  }
  return parameters;
}

double error(Eigen::VectorXd const& parameters, RegressionData const& data, Eigen::VectorXd const& oracle) {
  // in torque, over the torque: what a backward stable solution bounds
  return (data.phi * (parameters - oracle)).norm() / data.tau.norm();
}

// roundings that do not all agree, of every row that some QR has seen: a block and the triangle above it
double roundings(Eigen::Index rows, Eigen::Index block_rows) {
  Eigen::Index const blocks = (rows + block_rows - 1) / block_rows;
  return 0x1p-53 * std::sqrt(static_cast<double>(rows + 5 * (blocks - 1)));
}

TEST(RowReduction, OfOneBlockIsTheRowsThemselves) {
  auto const data = test::seed_data(20.0, 0.3);
  for (Eigen::Index const block_rows : {Eigen::Index{2000}, Eigen::Index{2001}, reduced_block_rows}) {
    auto const reduced = reduce_rows(data, {}, block_rows);
    EXPECT_EQ(reduced.phi, data.phi);
    EXPECT_EQ(reduced.tau, data.tau);
  }
}

TEST(RowReduction, SolvesLikeLongDoubleForEveryBlock) {
  auto const data = test::seed_data(20.0, 0.3);
  auto const oracle = solve_in_long_double(data);
  for (Eigen::Index const block_rows : block_sizes)
    EXPECT_LT(error(solve_in_blocks(data, block_rows), data, oracle), roundings(2000, block_rows)) << block_rows;
}

TEST(RowReduction, IsAsExactAsTheQrOfTheWholeOnManyRows) {
  // 100000 rows, 13 blocks: roundings would add up if every block cost some
  double of_blocks = 0.0, of_whole = 0.0;
  for (std::uint32_t draw = 0; draw < 8; ++draw) {
    auto const data = test::seed_data(1000.0, 0.3, draw);
    auto const oracle = solve_in_long_double(data);
    Eigen::VectorXd const length = column_lengths(data);
    Eigen::MatrixXd const scaled = data.phi * length.cwiseInverse().asDiagonal();
    Eigen::VectorXd const whole = test::least_squares(scaled, data.tau).cwiseQuotient(length);
    of_whole += error(whole, data, oracle) / 8.0;
    of_blocks += error(solve_weighted(data, {}), data, oracle) / 8.0;
    EXPECT_LT(error(solve_weighted(data, {}), data, oracle), roundings(100'000, reduced_block_rows));
  }
  EXPECT_LT(of_blocks, of_whole);  // 3e-15 and 9e-14
}

TEST(RowReduction, KeepsItsDigitsWhereNormalEquationsLoseThem) {
  // condition 2e7, whose square is beyond double precision
  auto data = test::seed_data(20.0);
  data.phi.col(1) = data.phi.col(0) + 1e-7 * data.phi.col(1);
  Eigen::Vector4d const truth(1.0, 2.0, 3.0, 4.0);
  data.tau = data.phi * truth;
  for (Eigen::Index const block_rows : block_sizes)
    EXPECT_LT((solve_in_blocks(data, block_rows) - truth).norm(), 1e-6) << block_rows;
}

TEST(RowReduction, WeighsRowsAndColumns) {
  auto const data = test::seed_data(20.0, 0.3);
  Eigen::VectorXd const weight = (data.dq.array().abs() + 0.5).matrix(), factor = Eigen::Vector4d(2.0, 0.5, 3.0, 7.0);
  RegressionData scaled = data;
  scaled.phi = weight.asDiagonal() * data.phi * factor.asDiagonal();
  scaled.tau = weight.cwiseProduct(data.tau);
  auto const oracle = solve_in_long_double(scaled);
  for (Eigen::Index const block_rows : block_sizes) {
    auto const reduced = reduce_rows(data, {weight, factor}, block_rows);
    Eigen::VectorXd const found = test::least_squares(reduced.phi, reduced.tau);
    EXPECT_LT(error(found, scaled, oracle), roundings(2000, block_rows)) << block_rows;
  }
  EXPECT_LT((column_lengths(data, weight) - (weight.asDiagonal() * data.phi).colwise().norm().transpose()).norm(),
            1e-14 * column_lengths(data, weight).norm());
}

TEST(RowReduction, HasTheTriangleOfAllRows) {
  auto const data = test::seed_data(20.0, 0.3);
  Eigen::MatrixXd const products = data.phi.transpose() * data.phi;
  for (Eigen::Index const block_rows : block_sizes) {
    auto const triangle = triangular_factor(data, {}, block_rows);
    EXPECT_TRUE(triangle.isUpperTriangular(0.0));
    EXPECT_LT((triangle.transpose() * triangle - products).norm(), 1e-13 * products.norm()) << block_rows;
  }
}

TEST(PredictionMetrics, OfManyBlocksAreThoseOfAllRows) {
  auto const data = test::seed_data(300.0, test::autoregressive_noise(30000, 0, 0.3, 0.999));  // a mean that wanders
  Eigen::Vector4d const anything(0.02, -0.1, 0.3, 0.2);
  Eigen::VectorX<long double> const residual =
      data.tau.cast<long double>() - data.phi.cast<long double>() * anything.cast<long double>();
  auto const mean = static_cast<double>(residual.mean());
  auto const std = static_cast<double>(
      std::sqrt((residual.array() - residual.mean()).square().sum() / static_cast<long double>(30000)));
  auto const metrics = prediction_metrics(data, anything);
  EXPECT_NEAR(metrics.sse / static_cast<double>(residual.squaredNorm()), 1.0, 1e-14);
  EXPECT_NEAR(metrics.residual_mean, mean, 1e-15);
  EXPECT_NEAR(metrics.residual_std / std, 1.0, 1e-14);
}

}  // namespace row_reduction_test
}  // namespace torquescope
