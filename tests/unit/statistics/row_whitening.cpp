// Noise of a known colour becomes white of the promised size, stretch by stretch, and nothing is enlarged.

#include "engine/fit/statistics/row_whitening.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/base/dense_solvers.hpp"

using torquescope::RowWhitening;
using torquescope::solve_positive;
using torquescope::whitening_of;

namespace row_whitening_test {

// three stretches of rows with gaps between them
std::vector<Eigen::Index> three_stretches(Eigen::Index each) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index first : {Eigen::Index{5}, 2 * each, 4 * each})
    for (Eigen::Index k = 0; k < each; ++k) rows.push_back(first + k);
  return rows;
}

// what an encoder makes of an acceleration: second differences of white noise, beside white noise of the torque
Eigen::MatrixXd differentiated_noise(std::vector<Eigen::Index> const& rows, Eigen::Index draws, double steps) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd noise(static_cast<Eigen::Index>(rows.size()), draws);
  Eigen::Index const n = rows.back() + 3;
  for (Eigen::Index draw = 0; draw < draws; ++draw) {
    Eigen::VectorXd encoder(n);
    for (double& one : encoder) one = normal(random);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      Eigen::Index const at = rows[k];
      noise(static_cast<Eigen::Index>(k), draw) =
          steps * (encoder[at] - 2.0 * encoder[at + 1] + encoder[at + 2]) + normal(random);
    }
  }
  return noise;
}

// root mean square of all rows, and the largest correlation of neighbours up to lag 5 within the first stretch
struct Whiteness {
  double std, largest_correlation;
};
Whiteness whiteness(Eigen::MatrixXd const& noise, Eigen::Index each) {
  double const variance = noise.squaredNorm() / static_cast<double>(noise.size());
  double largest = 0.0;
  for (Eigen::Index lag = 1; lag <= 5; ++lag) {
    double const product = noise.topRows(each - lag).cwiseProduct(noise.middleRows(lag, each - lag)).mean();
    largest = std::max(largest, std::abs(product) / variance);
  }
  return {std::sqrt(variance), largest};
}

TEST(RowWhitening, MakesDifferentiatedEncoderNoiseWhiteAndAsQuietAsItsQuietestFrequency) {
  Eigen::Index const each = 400;
  auto const rows = three_stretches(each);
  Eigen::MatrixXd noise = differentiated_noise(rows, 60, 3.0);
  ASSERT_GT(whiteness(noise, each).largest_correlation, 0.5);
  RowWhitening const whitening = whitening_of(noise, rows, 0.5);
  whitening.apply(noise, rows);
  auto const after = whiteness(noise, each);
  EXPECT_LT(after.largest_correlation, 0.03);
  EXPECT_NEAR(after.std, whitening.noise_std(), 0.03 * whitening.noise_std());
  // steady torque noise has standard deviation 1; the window of the spectrum lets a little of the loud band in
  EXPECT_NEAR(whitening.noise_std(), 1.0, 0.1);
}

TEST(RowWhitening, LeavesWhiteNoiseAlmostAsItIs) {
  auto const rows = three_stretches(300);
  Eigen::MatrixXd const noise = differentiated_noise(rows, 100, 0.0);
  Eigen::MatrixXd after = noise;
  whitening_of(noise, rows, 0.5).apply(after, rows);
  EXPECT_LT((after - noise).norm(), 0.1 * noise.norm());
}

TEST(RowWhitening, MakesLeastSquaresAsSureAsTheNoiseAllows) {
  // the least scatter of any unbiased estimate: 1 / sqrt(x' S^-1 x) for each draw, S the covariance of this noise
  Eigen::Index const each = 60, draws = 400;
  double const steps = 5.0;
  auto const rows = three_stretches(each);
  Eigen::MatrixXd noise = differentiated_noise(rows, draws, steps);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(noise.rows(), noise.rows());
  for (Eigen::Index i = 0; i < noise.rows(); ++i)
    for (Eigen::Index k = 0; k < noise.rows(); ++k) {
      if (i / each != k / each || std::abs(i - k) > 2) continue;
      covariance(i, k) += steps * steps * (i == k ? 6.0 : std::abs(i - k) == 1 ? -4.0 : 1.0);
    }
  Eigen::VectorXd signal(noise.rows());
  for (std::size_t k = 0; k < rows.size(); ++k)
    signal[static_cast<Eigen::Index>(k)] = std::sin(0.3 * static_cast<double>(rows[k]));
  double const least = std::sqrt(static_cast<double>(draws) / signal.dot(solve_positive(covariance, signal)));
  auto const scatter = [](Eigen::MatrixXd const& y, Eigen::VectorXd const& x) {
    return ((x.transpose() * y) / x.squaredNorm()).norm();
  };
  EXPECT_GT(scatter(noise, signal), 1.3 * least);
  RowWhitening const whitening = whitening_of(noise, rows, 0.5);
  whitening.apply(noise, rows);
  whitening.apply(signal, rows);
  EXPECT_NEAR(scatter(noise, signal) / least, 1.0, 0.15);
}

TEST(RowWhitening, TreatsEveryStretchAsIfItStoodAlone) {
  auto const rows = three_stretches(50);
  Eigen::MatrixXd const noise = differentiated_noise(rows, 40, 2.0);
  RowWhitening const whitening = whitening_of(noise, rows, 0.5);
  Eigen::MatrixXd together = noise, second = noise.middleRows(50, 50);
  whitening.apply(together, rows);
  whitening.apply(second, std::vector<Eigen::Index>(rows.begin() + 50, rows.begin() + 100));
  EXPECT_EQ(Eigen::MatrixXd(together.middleRows(50, 50)), second);
}

TEST(RowWhitening, NeverEnlargesWhatTheFilterLeftLittleOf) {
  // a filter took nearly everything above a fifth of the rate
  auto const rows = three_stretches(400);
  Eigen::MatrixXd noise = differentiated_noise(rows, 60, 0.0);
  for (int pass = 0; pass < 3; ++pass)
    for (Eigen::Index k = noise.rows() - 1; k > 0; --k) noise.row(k) = 0.5 * (noise.row(k) + noise.row(k - 1)).eval();
  double const before = noise.norm();
  whitening_of(noise, rows, 0.1).apply(noise, rows);
  EXPECT_LT(noise.norm(), 1.02 * before);
}

TEST(RowWhitening, IsNothingWithoutNoise) {
  auto const rows = three_stretches(50);
  RowWhitening const none = whitening_of(Eigen::MatrixXd::Zero(150, 16), rows, 0.5);
  EXPECT_TRUE(none.is_identity());
  Eigen::MatrixXd signal = Eigen::MatrixXd::Random(150, 2);
  Eigen::MatrixXd const before = signal;
  none.apply(signal, rows);
  EXPECT_EQ(signal, before);
}

}  // namespace row_whitening_test
