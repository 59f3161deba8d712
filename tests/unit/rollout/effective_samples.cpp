// A residual is worth as many squares as the variance of its mean square says.

#include "engine/simulate/rollout/effective_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"

using namespace torquescope;

namespace effective_samples_test {

Eigen::VectorXd autoregression(double a, Eigen::Index n, std::uint32_t draw) {
  RandomStream random({11, 0, RandomDomain::test}, 0, draw);
  Eigen::VectorXd series(n);
  double value = random.normal() / std::sqrt(1.0 - a * a);
  for (Eigen::Index k = 0; k < n; ++k) {
    series[k] = value;
    value = a * value + random.normal();
  }
  return series;
}

constexpr Eigen::Index n = 20000;

TEST(EffectiveSamples, OfWhiteNoiseAreNearlyAll) {
  // the taper's 2000 lags add chance of 2 / 3 of them over n squared each way: some percent
  for (std::uint32_t draw = 0; draw < 5; ++draw) {
    double const share = effective_samples(autoregression(0.0, n, draw)) / n;
    EXPECT_GT(share, 0.85) << draw;
    EXPECT_LE(share, 1.0) << draw;
  }
}

TEST(EffectiveSamples, OfAnAutoregressionAreThoseOfItsSquares) {
  for (double const a : {0.3, -0.6, 0.9, 0.98}) {
    double const theory = n * (1.0 - a * a) / (1.0 + a * a);
    double sum = 0.0;
    for (std::uint32_t draw = 0; draw < 5; ++draw) sum += effective_samples(autoregression(a, n, draw)) / 5.0;
    // each correlation is known to some percent, and those of chance are counted as well
    EXPECT_NEAR(sum, theory, 0.15 * theory) << a;
  }
}

// what the number stands for: the spread of sums of squares over many draws
TEST(EffectiveSamples, TellTheSpreadOfSumsOfSquares) {
  constexpr double a = 0.8;
  constexpr int draws = 400;
  constexpr Eigen::Index length = 2000;
  double sum = 0.0, squares = 0.0, told = 0.0;
  for (std::uint32_t draw = 0; draw < draws; ++draw) {
    Eigen::VectorXd const series = autoregression(a, length, draw);
    double const energy = series.squaredNorm() / static_cast<double>(length);
    sum += energy / draws;
    squares += energy * energy / draws;
    told += effective_samples(series) / draws;
  }
  double const relative_variance = (squares - sum * sum) / (sum * sum);
  // the variance of 400 draws is known to a fourteenth, and twice that is rarely met
  EXPECT_NEAR(2.0 / relative_variance / told, 1.0, 0.2);
}

TEST(EffectiveSamples, OfZerosAreTheirNumber) {
  EXPECT_EQ(effective_samples(Eigen::VectorXd::Zero(123)), 123.0);
  EXPECT_EQ(effective_samples(Eigen::VectorXd::Ones(1)), 1.0);
  EXPECT_EQ(effective_samples(Eigen::VectorXd()), 0.0);
}

TEST(EffectiveSamples, DoNotDependOnTheUnit) {
  Eigen::VectorXd const series = autoregression(0.7, 3000, 1);
  EXPECT_NEAR(effective_samples(1e-6 * series), effective_samples(series), 1e-6);
}

}  // namespace effective_samples_test
