// Friction that wanders by itself counts for little, what it cannot imitate in full; against the inverse root of the
// covariance.

#include "engine/infer/pipeline/noise_weights.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <random>

#include "support/decompositions.hpp"

using torquescope::NoiseWeights;
using torquescope::RowWhitening;
using torquescope::WanderOnRows;
using torquescope::test::eigenvalues;

namespace noise_weights_test {

constexpr Eigen::Index n = 300;
constexpr double duration_s = 30.0;

std::vector<Eigen::Index> all_rows() {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index k = 0; k < n; ++k) rows.push_back(k);
  return rows;
}

// forth and back every three seconds
Eigen::VectorXd friction() {
  Eigen::VectorXd level(n);
  for (Eigen::Index k = 0; k < n; ++k) level[k] = (k / 30) % 2 == 0 ? 2.0 : -2.0;
  return level;
}

// white rows of unit noise
NoiseWeights white_rows() {
  std::vector<double> const covariance{1.0};
  return NoiseWeights(RowWhitening(covariance, 1.0));
}

void apply(NoiseWeights const& weights, Eigen::Ref<Eigen::MatrixXd> signals) {
  weights.apply(signals, all_rows(), weights.wander_on(all_rows()));
}

TEST(NoiseWeights, AreTheInverseRootOfTheCovariance) {
  NoiseWeights const weights = white_rows().with_wander(friction(), duration_s, 1e-2);
  Eigen::MatrixXd root = Eigen::MatrixXd::Identity(n, n);
  apply(weights, root);
  // covariance of a random walk less its mean, sampled at the middle of every row: s^2 (T/3 - max + (a^2 + b^2) / (2
  // T))
  Eigen::MatrixXd covariance(n, n);
  Eigen::VectorXd const level = friction();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k) {
      double const a = (static_cast<double>(i) + 0.5) / n * duration_s,
                   b = (static_cast<double>(k) + 0.5) / n * duration_s;
      double const walk = duration_s / 3.0 - std::max(a, b) + (a * a + b * b) / (2.0 * duration_s);
      covariance(i, k) = 1e-2 * level[i] * level[k] * walk + (i == k ? 1.0 : 0.0);
    }
  Eigen::MatrixXd const white = root * covariance * root.transpose();
  Eigen::VectorXd const values = eigenvalues(white);
  // sixteen modes leave the fastest part of the walk in
  EXPECT_NEAR(values.minCoeff(), 1.0, 0.02);
  EXPECT_LT(values.maxCoeff(), 1.2);
  EXPECT_GT(eigenvalues(covariance).maxCoeff(), 30.0);
}

TEST(NoiseWeights, ShrinkAWanderAndSpareWhatItCannotImitate) {
  NoiseWeights const weights = white_rows().with_wander(friction(), duration_s, 1e-2);
  Eigen::MatrixXd signals(n, 2);
  for (Eigen::Index k = 0; k < n; ++k) {
    signals(k, 0) = friction()[k] * std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) / n);
    signals(k, 1) = std::sin(2.0 * std::numbers::pi * 70.3 * static_cast<double>(k) / n);  // of no direction
  }
  Eigen::MatrixXd const before = signals;
  apply(weights, signals);
  EXPECT_LT(signals.col(0).norm(), 0.2 * before.col(0).norm());
  EXPECT_GT(signals.col(1).norm(), 0.9 * before.col(1).norm());
}

TEST(NoiseWeights, MultiplyRowsByTheirShareAndKeepTheWalk) {
  Eigen::VectorXd shares = Eigen::VectorXd::Ones(n);
  shares.segment(100, 50).setConstant(0.25);
  shares[120] = 0.0;
  NoiseWeights const weights = white_rows().with_shares(shares);
  EXPECT_TRUE(weights.weigh_reversals());
  EXPECT_FALSE(weights.are_equal());
  EXPECT_FALSE(NoiseWeights().with_shares(shares).are_equal());
  Eigen::MatrixXd const before = Eigen::MatrixXd::Random(n, 3);
  Eigen::MatrixXd signals = before;
  apply(weights, signals);
  EXPECT_EQ(signals, Eigen::MatrixXd(shares.asDiagonal() * before));

  // a few rows only: by their place among all kept samples
  std::vector<Eigen::Index> const some{99, 100, 120, 200};
  Eigen::MatrixXd few = Eigen::MatrixXd::Ones(4, 1);
  weights.apply_rows(few, some);
  EXPECT_EQ(few, (Eigen::MatrixXd(4, 1) << 1.0, 0.25, 0.0, 1.0).finished());

  NoiseWeights const both = weights.with_wander(friction(), duration_s, 1e-2);
  EXPECT_TRUE(both.weigh_reversals() && both.wanders());
  WanderOnRows const walk = both.wander_on(all_rows());
  EXPECT_EQ(walk.modes.row(120).norm(), 0.0);
  EXPECT_GT(walk.modes.row(99).norm(), 0.0);
}

TEST(NoiseWeights, WithoutWanderOrWithoutNoiseAreThoseOfTheRows) {
  EXPECT_FALSE(white_rows().with_wander(friction(), duration_s, 0.0).wanders());
  EXPECT_FALSE(NoiseWeights().with_wander(friction(), duration_s, 1.0).wanders());
  EXPECT_TRUE(NoiseWeights().are_equal());
  EXPECT_FALSE(white_rows().are_equal());
}

}  // namespace noise_weights_test
