#include <gmock/gmock.h>

#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace irls_test {

using test::fit;

// every tenth sample carries a large torque of one sign: a cable that catches
RegressionData with_outliers(std::uint32_t run) {
  auto data = test::seed_data(20.0, 0.02, run);
  for (Eigen::Index t = 3; t < data.rows(); t += 10) data.tau[t] += 2.0 + 0.001 * static_cast<double>(t % 100);
  return data;
}

TEST(Irls, ResistsTenPercentOneSidedOutliers) {
  double ols = 0.0, irls = 0.0;
  for (std::uint32_t run = 0; run < 10; ++run) {
    auto const data = with_outliers(run);
    ols += (fit("ols", data).parameters - test::seed_ols).norm();
    irls += (fit("irls", data).parameters - test::seed_ols).norm();
  }
  EXPECT_LT(irls, 0.05 * ols);
}

TEST(Irls, SolvesHubersEquations) {
  // at the solution sum_t psi(e_t) phi_t = 0 with psi clipped at 1.345 scales
  auto const data = with_outliers(0);
  auto const result = fit("irls", data);
  ASSERT_TRUE(result.converged);
  double const limit = 1.345 * result.scale;
  Eigen::VectorXd const psi = (data.tau - data.phi * result.parameters).cwiseMin(limit).cwiseMax(-limit);
  for (Eigen::Index r = 0; r < 4; ++r)
    EXPECT_LT(std::abs(data.phi.col(r).dot(psi)), 1e-8 * data.phi.col(r).norm() * psi.norm()) << r;
}

TEST(Irls, ScaleIsTheMedianAbsoluteResidualOfAGaussian) {
  auto const result = fit("irls", test::seed_data(100.0, 0.3));
  EXPECT_NEAR(result.scale, 0.3, 0.3 * 4.0 * 1.17 / 100.0);  // MAD of n = 10000: 1.17 / sqrt(n) relative, 4 sigma
}

TEST(Irls, WithWideTuningIsOls) {
  auto const data = test::seed_data(10.0, 0.3);
  auto const wide = fit("irls", data, {{"tuning", 100.0}});
  auto const ols = fit("ols", data);
  EXPECT_LT((wide.parameters - ols.parameters).norm(), 1e-12);
  EXPECT_LT((wide.standard_error - ols.standard_error).norm(), 1e-10 * ols.standard_error.norm());
  EXPECT_LT((wide.covariance_naive - ols.covariance_naive).norm(), 1e-10 * ols.covariance_naive.norm());
  EXPECT_EQ(wide.weights.minCoeff(), 1.0);
}

TEST(Irls, GivesOutliersSmallWeights) {
  auto const result = fit("irls", with_outliers(0));
  EXPECT_LT(result.weights[3], 0.05);
  EXPECT_GT(result.weights.mean(), 0.8);
}

TEST(Irls, IntervalsCoverTheTruthUnderSymmetricOutliers) {
  auto data = test::seed_data(10.0);
  Eigen::VectorXd const clean = data.tau;
  double covered = 0.0;
  for (std::uint32_t run = 0; run < 200; ++run) {
    data.tau = clean + test::white_noise(1000, run, 0.05);
    auto const far = test::white_noise(1000, 1000 + run, 3.0);
    for (Eigen::Index t = 0; t < 1000; t += 10) data.tau[t] += far[t];
    auto const ci95 = fit("irls", data).ci95;
    for (Eigen::Index r = 0; r < 4; ++r)
      covered += (test::seed_ols[r] >= ci95(r, 0) && test::seed_ols[r] <= ci95(r, 1)) / 800.0;
  }
  // 200 draws of 4 correlated intervals: deviation below 1.5 %
  EXPECT_NEAR(covered, 0.95, 0.04);
}

TEST(Irls, AnswersWhenOneDirectionHoldsOnlyFarResiduals) {
  // rounding-free model forwards, an unmodelled torque backwards: the scale is that of the forward rows
  auto data = test::seed_data(20.0, 1e-6);
  for (Eigen::Index t = 0; t < data.rows(); ++t)
    if (data.dq[t] < 0.0) data.tau[t] += 0.5 * std::sin(40.0 * data.q[t]);
  auto const result = fit("irls", data, {{"max_iterations", std::int64_t{1000}}});
  EXPECT_TRUE(result.standard_error.allFinite());
  EXPECT_TRUE(result.parameters.allFinite());
}

TEST(Irls, SaysWhenItDidNotConverge) {
  auto const result = fit("irls", with_outliers(0), {{"max_iterations", std::int64_t{2}}});
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_THAT(result.remark, testing::HasSubstr("max_iterations = 2"));
}

TEST(Irls, IntervalsOfGaussianDataAreFivePercentWider) {
  // efficiency 95 % at k = 1.345: variance 1 / 0.95
  auto const data = test::seed_data(400.0, 0.3);
  double const ratio = fit("irls", data).covariance_naive(1, 1) / fit("ols", data).covariance_naive(1, 1);
  EXPECT_NEAR(ratio, 1.0 / 0.95, 0.02);
}

}  // namespace irls_test
}  // namespace torquescope
