#include "engine/fit/optim/covariance_adaptation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace covariance_adaptation_test {

Eigen::MatrixXd deviates(Eigen::Index rows, Eigen::Index columns, std::uint32_t generation) {
  RandomStream random({7, 0, RandomDomain::test}, generation, 0);
  Eigen::MatrixXd z(rows, columns);
  for (double& number : z.reshaped()) number = random.normal();
  return z;
}

// one parameter, four samples, by hand: two count, with weights ln 2.5 and ln 2.5 - ln 2 over their sum
TEST(CovarianceAdaptation, TakesTheFirstStepOfTheTutorial) {
  CovarianceAdaptation distribution(Eigen::VectorXd::Constant(1, 0.4), 0.3, 4);
  double const a = std::log(2.5), b = std::log(1.25);
  double const w1 = a / (a + b), w2 = b / (a + b);
  double const mu_eff = 1.0 / (w1 * w1 + w2 * w2);
  Eigen::MatrixXd z(1, 4);
  z << 0.5, -0.2, 1.0, -1.5;
  distribution.learn(z);
  double const y = w1 * 0.5 - w2 * 0.2;
  EXPECT_NEAR(distribution.mean()[0], 0.4 + 0.3 * y, 1e-15);

  double const c_sigma = (mu_eff + 2.0) / (mu_eff + 6.0);
  double const path = std::sqrt(c_sigma * (2.0 - c_sigma) * mu_eff) * y;
  double const d_sigma = 1.0 + 2.0 * std::max(0.0, std::sqrt((mu_eff - 1.0) / 2.0) - 1.0) + c_sigma;
  double const usual = 1.0 - 0.25 + 1.0 / 21.0;
  EXPECT_NEAR(distribution.sigma(), 0.3 * std::exp(c_sigma / d_sigma * (std::fabs(path) / usual - 1.0)), 1e-15);

  double const c_c = (4.0 + mu_eff) / (5.0 + 2.0 * mu_eff);
  double const path_c = std::sqrt(c_c * (2.0 - c_c) * mu_eff) * y;
  double const c_1 = 2.0 / (2.3 * 2.3 + mu_eff);
  double const c_mu = 2.0 * (mu_eff - 2.0 + 1.0 / mu_eff) / (9.0 + mu_eff);
  double const C = 1.0 - c_1 - c_mu + c_1 * path_c * path_c + c_mu * (w1 * 0.25 + w2 * 0.04);
  EXPECT_NEAR(distribution.covariance()(0, 0), C, 1e-15);
}

// a step so long that sigma is far too small: the rank-one path waits, and what it does not add is not lost either
TEST(CovarianceAdaptation, LeavesALongStepToTheStepSize) {
  CovarianceAdaptation distribution(Eigen::VectorXd::Constant(1, 0.4), 0.01, 4);
  double const a = std::log(2.5), b = std::log(1.25);
  double const w1 = a / (a + b), w2 = b / (a + b);
  double const mu_eff = 1.0 / (w1 * w1 + w2 * w2);
  distribution.learn(Eigen::MatrixXd{{3.0, 2.5}});
  double const c_c = (4.0 + mu_eff) / (5.0 + 2.0 * mu_eff);
  double const c_1 = 2.0 / (2.3 * 2.3 + mu_eff);
  double const c_mu = 2.0 * (mu_eff - 2.0 + 1.0 / mu_eff) / (9.0 + mu_eff);
  double const C = 1.0 - c_1 - c_mu + c_1 * c_c * (2.0 - c_c) + c_mu * (w1 * 9.0 + w2 * 6.25);
  EXPECT_NEAR(distribution.covariance()(0, 0), C, 1e-15);
}

// without selection nothing is learned: ln sigma makes a random walk, and C stays near the identity
TEST(CovarianceAdaptation, IsUnbiasedUnderRandomSelection) {
  double ln_sigma = 0.0, trace = 0.0;
  constexpr int walks = 200;
  for (std::uint32_t walk = 0; walk < walks; ++walk) {
    CovarianceAdaptation distribution(Eigen::VectorXd::Zero(5), 1e-3, 10);
    for (std::uint32_t generation = 0; generation < 30; ++generation)
      distribution.learn(deviates(5, 10, 100 * walk + generation));
    ln_sigma += std::log(distribution.sigma() / 1e-3) / walks;
    trace += distribution.covariance().trace() / 5.0 / walks;
  }
  // the walks spread by about 1 in ln sigma and 0.4 in the trace; sigma starts with a path of length 0, so it falls a
  // little
  EXPECT_NEAR(ln_sigma, 0.0, 0.5);
  EXPECT_NEAR(trace, 1.0, 0.15);
}

TEST(CovarianceAdaptation, SamplesWithItsCovariance) {
  CovarianceAdaptation distribution(Eigen::VectorXd::Constant(3, 0.5), 0.2, 8);
  for (std::uint32_t generation = 0; generation < 20; ++generation) distribution.learn(deviates(3, 8, generation));
  // x - m = sigma A z: A A^T = C
  Eigen::MatrixXd A(3, 3);
  for (Eigen::Index j = 0; j < 3; ++j)
    A.col(j) = (distribution.sample(Eigen::VectorXd::Unit(3, j)) - distribution.mean()) / distribution.sigma();
  EXPECT_LT((A * A.transpose() - distribution.covariance()).norm(), 1e-12 * distribution.covariance().norm());
  EXPECT_EQ(distribution.covariance(), distribution.covariance().transpose());
}

TEST(CovarianceAdaptation, LearnsFromThoseThatAreLeft) {
  CovarianceAdaptation none(Eigen::VectorXd::Zero(2), 0.3, 8);
  auto const before = none.numbers();
  none.learn(Eigen::MatrixXd(2, 0));
  EXPECT_EQ(none.numbers(), before);
  // one sample has the whole weight: the mean goes there
  CovarianceAdaptation one(Eigen::VectorXd::Zero(2), 0.3, 8);
  Eigen::VectorXd const z = deviates(2, 1, 3);
  Eigen::VectorXd const there = one.sample(z);
  one.learn(z);
  EXPECT_LT((one.mean() - there).norm(), 1e-15);
}

TEST(CovarianceAdaptation, NeverGrowsBeyondTheBoxAndSaysWhenItHasCollapsed) {
  CovarianceAdaptation growing(Eigen::VectorXd::Zero(2), 0.3, 8);
  // always the same direction: steps grow
  Eigen::MatrixXd const ahead = Eigen::MatrixXd::Constant(2, 4, 2.0);
  for (int generation = 0; generation < 60; ++generation) growing.learn(ahead);
  double largest = 0.0;
  for (Eigen::Index j = 0; j < 2; ++j) largest = std::max(largest, growing.covariance()(j, j));
  EXPECT_LE(growing.sigma() * std::sqrt(largest), 1.0 + 1e-12);

  CovarianceAdaptation shrinking(Eigen::VectorXd::Zero(2), 0.3, 8);
  EXPECT_FALSE(shrinking.is_collapsed());
  for (int generation = 0; generation < 200 && !shrinking.is_collapsed(); ++generation)
    shrinking.learn(Eigen::MatrixXd::Zero(2, 4));
  EXPECT_TRUE(shrinking.is_collapsed());
}

TEST(CovarianceAdaptation, GoesOnFromItsNumbers) {
  CovarianceAdaptation distribution(Eigen::VectorXd::Zero(4), 0.3, 9);
  for (std::uint32_t generation = 0; generation < 7; ++generation) distribution.learn(deviates(4, 9, generation));
  CovarianceAdaptation copy(Eigen::VectorXd::Ones(4), 0.1, 9);
  copy.restore(distribution.numbers());
  for (auto* one : {&distribution, &copy}) one->learn(deviates(4, 9, 50));
  EXPECT_EQ(copy.numbers(), distribution.numbers());
}

// the worse half moves nothing but C, and only along its steps
TEST(CovarianceAdaptation, TheWorseHalfTakesVarianceAwayAlongItsSteps) {
  Eigen::VectorXd const mean = Eigen::VectorXd::Constant(3, 0.5);
  CovarianceAdaptation without(mean, 0.3, 10), with = without;
  Eigen::MatrixXd const better = deviates(3, 5, 1);
  Eigen::MatrixXd worse = Eigen::MatrixXd::Zero(3, 4);
  worse.row(1) << 1.0, -0.5, 2.0, -3.0;
  without.learn(better);
  with.learn(better, worse);
  EXPECT_EQ(with.mean(), without.mean());
  EXPECT_EQ(with.sigma(), without.sigma());
  // what is not taken away there is not forgotten elsewhere: the weights sum to less
  Eigen::MatrixXd const change = with.covariance() - without.covariance();
  EXPECT_LT(change(1, 1), -0.01);
  EXPECT_GT(change(0, 0), 0.0);
  EXPECT_NEAR(change(0, 0), change(2, 2), 1e-15);
}

TEST(CovarianceAdaptation, StaysPositiveWhateverTheWorseHalfIs) {
  CovarianceAdaptation distribution(Eigen::VectorXd::Constant(4, 0.5), 0.3, 8);
  for (std::uint32_t generation = 0; generation < 300; ++generation) {
    Eigen::MatrixXd const z = deviates(4, 8, generation);
    distribution.learn(z.leftCols(4), 1e3 * z.rightCols(4));
    Eigen::LDLT<Eigen::MatrixXd> const factor(distribution.covariance());
    ASSERT_TRUE(factor.isPositive()) << generation;
  }
}

TEST(CovarianceAdaptation, KnowsTheDeviatesOfAPlace) {
  CovarianceAdaptation distribution(Eigen::VectorXd::Constant(4, 0.5), 0.3, 8);
  for (std::uint32_t generation = 0; generation < 20; ++generation) distribution.learn(deviates(4, 8, generation));
  Eigen::VectorXd const z = deviates(4, 1, 99);
  EXPECT_LT((distribution.deviates_of(distribution.sample(z)) - z).norm(), 1e-12);
}

}  // namespace covariance_adaptation_test
}  // namespace torquescope
