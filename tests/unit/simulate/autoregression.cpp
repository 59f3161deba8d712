// Coloured noise as an autoregression.

#include "engine/simulate/autoregression.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"

using namespace torquescope;

namespace autoregression_test {

// x_k = 1.5 x_(k-1) - 0.8 x_(k-2) + n_k
Eigen::VectorXd ringing_noise(Eigen::Index n) {
  RandomStream random({5, 0, RandomDomain::test}, 0, 0);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n + 500);
  for (Eigen::Index k = 2; k < x.size(); ++k) x[k] = 1.5 * x[k - 1] - 0.8 * x[k - 2] + random.normal();
  return x.tail(n);
}

TEST(Autoregression, FindsTheControllerOfARingingNoise) {
  Eigen::Index const n = 40000;
  auto const found = fit_autoregression(ringing_noise(n));
  ASSERT_GE(found.past.size(), 2u);
  // asymptotic standard error of both: sqrt((1 - 0.8^2) / n) = 0.003
  EXPECT_NEAR(found.past[0], 1.5, 0.015);
  EXPECT_NEAR(found.past[1], -0.8, 0.015);
  EXPECT_NEAR(found.innovation, 1.0, 4.0 / std::sqrt(2.0 * static_cast<double>(n)));
}

TEST(Autoregression, LeavesNothingToPredict) {
  auto const x = ringing_noise(20000);
  auto const found = fit_autoregression(x);
  auto const order = static_cast<Eigen::Index>(found.past.size());
  Eigen::VectorXd e = x.tail(x.size() - order);
  for (Eigen::Index i = 0; i < order; ++i)
    e -= found.past[static_cast<std::size_t>(i)] * x.segment(order - 1 - i, e.size());
  for (Eigen::Index lag : {1, 2, 5, 20}) EXPECT_LT(std::abs(autocorrelation(e, lag)), 4.0 / std::sqrt(20000.0)) << lag;
}

TEST(Autoregression, OfNothingIsNothing) {
  auto const found = fit_autoregression(Eigen::VectorXd::Zero(100));
  EXPECT_EQ(found.std, 0.0);
  EXPECT_EQ(found.innovation, 0.0);
  EXPECT_TRUE(found.past.empty());
}

}  // namespace autoregression_test
