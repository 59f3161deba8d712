// Each textbook null is the one its name says: white noise of the residual's size, the Newey-West covariance, the
// residual's own spectrum. And all of them keep the place and the shape of the twins.

#include "engine/infer/replicates/null_kind.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"
#include "engine/fit/problem/hac.hpp"
#include "support/decompositions.hpp"

using namespace torquescope;

namespace null_kind_test {

constexpr Eigen::Index n = 1500;  // a length the fast transform likes
constexpr Eigen::Index draws = 1500;

Eigen::VectorXd autoregression(double memory, std::uint32_t member) {
  RandomStream random({17, 0, RandomDomain::test}, 0, member);
  Eigen::VectorXd noise(n);
  double value = 0.0;
  for (double& one : noise) {
    value = memory * value + random.normal();
    one = value;
  }
  return noise;
}

// a fit of a constant and a ramp to red noise
TwinComparison comparison_of(double memory) {
  TwinComparison comparison;
  auto& record = comparison.recording;
  record.columns.resize(n, 2);
  record.columns.col(0).setOnes();
  record.columns.col(1) = Eigen::VectorXd::LinSpaced(n, -1.0, 1.0);
  record.torque = autoregression(memory, 1);
  record.parameters = test::least_squares(record.columns, record.torque);
  record.residual = record.torque - record.columns * record.parameters;
  comparison.rows.residual = record.residual;
  comparison.rows.twins = Eigen::MatrixXd::Constant(n, draws, 7.0);
  comparison.rows.twin_mean = Eigen::VectorXd::Constant(n, 7.0);
  comparison.twin_fits = Eigen::MatrixXd::Zero(draws, 2);
  return comparison;
}

double circular_autocovariance(Eigen::VectorXd const& x, Eigen::Index lag) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) sum += x[i] * x[(i + lag) % x.size()];
  return sum;
}

TEST(NullKind, TwinsStayTwins) {
  auto comparison = comparison_of(0.5);
  replace_null(comparison, NullKind::twins, 1, 2);
  EXPECT_EQ(comparison.rows.twins, Eigen::MatrixXd::Constant(n, draws, 7.0));
  EXPECT_EQ(null_of("twins"), NullKind::twins);
  EXPECT_EQ(null_of("surrogate"), NullKind::surrogate);
}

TEST(NullKind, DrawsAreFittedLikeTwins) {
  for (NullKind kind : {NullKind::iid, NullKind::hac, NullKind::surrogate}) {
    auto comparison = comparison_of(0.5);
    auto const& rows = comparison.rows;
    replace_null(comparison, kind, 1, 2);
    ASSERT_EQ(rows.twins.rows(), n);
    ASSERT_EQ(rows.twins.cols(), draws);
    Eigen::MatrixXd const left = comparison.recording.columns.transpose() * rows.twins;
    EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-8 * rows.twins.norm());
    EXPECT_LT((rows.twin_mean - rows.twins.rowwise().mean()).norm(), 1e-12);
    // their fits lie round the recording's
    Eigen::VectorXd const mean = comparison.twin_fits.colwise().mean();
    Eigen::VectorXd const spread =
        (comparison.twin_fits.rowwise() - mean.transpose()).colwise().norm() / std::sqrt(static_cast<double>(draws));
    for (Eigen::Index k = 0; k < 2; ++k) {
      // the mean of a surrogate is that of the residual: zero
      if (kind == NullKind::surrogate && k == 0) continue;
      EXPECT_LT(std::abs(mean[k] - comparison.recording.parameters[k]), 5.0 * spread[k] / std::sqrt(draws) + 1e-9);
    }
  }
}

TEST(NullKind, EveryNullHasTheEnergyOfTheResidual) {
  for (NullKind kind : {NullKind::iid, NullKind::hac, NullKind::surrogate}) {
    auto comparison = comparison_of(0.5);
    replace_null(comparison, kind, 1, 2);
    double const energy = comparison.rows.twins.squaredNorm() / static_cast<double>(draws);
    // the mean of 1500 draws is exact to a few hundredths; the ramp takes more of red noise than of white
    EXPECT_NEAR(energy / comparison.recording.residual.squaredNorm(), 1.0, 0.03);
  }
}

TEST(NullKind, IidNeighboursKnowNothingOfEachOther) {
  auto comparison = comparison_of(0.9);
  replace_null(comparison, NullKind::iid, 1, 2);
  double correlation = 0.0;
  for (Eigen::Index i = 0; i < draws; ++i) {
    Eigen::VectorXd const draw = comparison.rows.twins.col(i);
    correlation += circular_autocovariance(draw, 1) / draw.squaredNorm() / static_cast<double>(draws);
  }
  EXPECT_NEAR(correlation, 0.0, 0.005);
}

TEST(NullKind, TheVarianceOfAStatisticIsItsNeweyWestEstimate) {
  auto comparison = comparison_of(0.8);
  auto const& residual = comparison.recording.residual;
  auto const& columns = comparison.recording.columns;
  Eigen::VectorXd const statistic = test::left_beside(columns, autoregression(0.8, 2));
  std::vector<Eigen::Index> const whole{0, n};
  auto const span = static_cast<double>(andrews_lags({columns, residual, whole}) + 1);
  ASSERT_GT(span, 5.0);
  Eigen::VectorXd const score = statistic.cwiseProduct(residual);
  double wanted = 0.0;
  for (Eigen::Index s = 0; s < n; ++s)
    for (Eigen::Index t = 0; t < n; ++t)
      wanted += score[s] * score[t] * std::max(0.0, 1.0 - std::abs(static_cast<double>(s - t)) / span);
  wanted *= static_cast<double>(n) / static_cast<double>(n - 2);
  replace_null(comparison, NullKind::hac, 1, 2);
  double const found = (comparison.rows.twins.transpose() * statistic).squaredNorm() / static_cast<double>(draws);
  // a variance from 1500 draws: 3.7 % standard error
  EXPECT_NEAR(found / wanted, 1.0, 0.15);
}

TEST(NullKind, SurrogatesHaveTheSpectrumOfTheResidual) {
  auto comparison = comparison_of(0.8);
  // no trend to fit: a surrogate stays as it was drawn
  auto& record = comparison.recording;
  record.columns.conservativeResize(Eigen::NoChange, 1);
  record.parameters = Eigen::VectorXd::Constant(1, record.torque.mean());
  record.residual = record.torque.array() - record.torque.mean();
  replace_null(comparison, NullKind::surrogate, 1, 2);
  double const enlarged = static_cast<double>(n) / static_cast<double>(n - 1);
  for (Eigen::Index i : {0, 1, 1000})
    for (Eigen::Index lag : {0, 1, 2, 10, 100}) {
      Eigen::VectorXd const draw = comparison.rows.twins.col(i);
      EXPECT_NEAR(circular_autocovariance(draw, lag), enlarged * circular_autocovariance(record.residual, lag),
                  1e-9 * record.residual.squaredNorm());
    }
  EXPECT_GT((comparison.rows.twins.col(0) - comparison.rows.twins.col(1)).norm(), record.residual.norm());
}

TEST(NullKind, HasTheSameBitsForAnyNumberOfThreads) {
  for (NullKind kind : {NullKind::iid, NullKind::hac, NullKind::surrogate}) {
    auto alone = comparison_of(0.5), together = comparison_of(0.5), other = comparison_of(0.5);
    replace_null(alone, kind, 5, 1);
    replace_null(together, kind, 5, 3);
    replace_null(other, kind, 6, 1);
    EXPECT_EQ(alone.rows.twins, together.rows.twins);
    EXPECT_NE(alone.rows.twins, other.rows.twins);
  }
}

}  // namespace null_kind_test
