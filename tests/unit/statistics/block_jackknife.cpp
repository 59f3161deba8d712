// The jackknife over blocks: as large as chance where the effect is right, larger where it is not, silent on what
// happens once.

#include "engine/fit/statistics/block_jackknife.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using torquescope::jackknife_deviations;

namespace block_jackknife_test {

constexpr Eigen::Index n = 2000;

Eigen::VectorXd noise(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd values(n);
  for (double& one : values) one = normal(random);
  return values;
}

Eigen::MatrixXd wave() {
  Eigen::MatrixXd column(n, 1);
  for (Eigen::Index k = 0; k < n; ++k) column(k, 0) = std::sin(0.1 * static_cast<double>(k));
  return column;
}

TEST(BlockJackknife, IsTheStandardErrorOfLeastSquaresWhenTheEffectIsRight) {
  double mean_square = 0.0;
  constexpr int draws = 200;
  for (std::uint64_t seed = 1; seed <= draws; ++seed) {
    double const one = jackknife_deviations(noise(seed), wave())[0];
    mean_square += one * one / draws;
  }
  EXPECT_NEAR(std::sqrt(mean_square) * wave().norm(), 1.0, 0.1);
}

TEST(BlockJackknife, GrowsWhenOneNumberDoesNotFitAllOfTheRecord) {
  // the coefficient doubles half-way through
  Eigen::VectorXd signal = wave().col(0);
  signal.tail(n / 2) *= 2.0;
  double const chance = 1.0 / wave().norm();
  EXPECT_GT(jackknife_deviations(signal, wave())[0], 0.1);
  EXPECT_GT(jackknife_deviations(signal + 0.01 * noise(3), wave())[0], 100.0 * 0.01 * chance);
}

TEST(BlockJackknife, SaysNothingOfWhatHappensInOneBlock) {
  Eigen::MatrixXd columns(n, 2);
  columns.col(0) = wave();
  columns.col(1).setZero();
  columns.col(1).segment(500, 40).setOnes();
  Eigen::VectorXd const found = jackknife_deviations(noise(5) + 3.0 * columns.col(1), columns);
  EXPECT_LT(found[1], 1.0);
  EXPECT_NEAR(found[0] * wave().norm(), 1.0, 0.6);
}

}  // namespace block_jackknife_test
