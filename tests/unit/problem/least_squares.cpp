// Properties of ols and wls, and of the words that every estimator owes its user.

#include "engine/fit/problem/least_squares.hpp"

#include <gmock/gmock.h>

#include <array>
#include <vector>

#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace least_squares_test {

using test::fit;
using test::largest_relative_difference;
using testing::HasSubstr;

std::vector<EstimatorChoice> for_any_rows() {
  std::vector<EstimatorChoice> choices = estimator_choices();
  std::erase_if(choices, [](EstimatorChoice const& one) { return !one.fits_any_rows(); });
  return choices;
}

class EveryEstimator : public testing::TestWithParam<EstimatorChoice> {};

TEST_P(EveryEstimator, RecoversTheParametersOfNoiseFreeData) {
  auto const result = fit(GetParam().name, test::seed_data(10.0));
  // condition number below 10, torque rounded once: a few hundred roundings
  EXPECT_LT(largest_relative_difference(result.parameters, test::seed_ols), 1e-12);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.metrics.relerr, 1e-14);
}

TEST_P(EveryEstimator, FollowsTheUnitsOfTorqueAndMotion) {
  auto const data = test::seed_data(10.0, 0.05);
  auto scaled = data;
  scaled.tau *= 1024.0;
  scaled.phi.col(0) *= 64.0;  // powers of two: exact
  auto const before = fit(GetParam().name, data), after = fit(GetParam().name, scaled);
  EXPECT_LT(largest_relative_difference(after.parameters.cwiseProduct(Eigen::Vector4d(64.0, 1.0, 1.0, 1.0)),
                                        1024.0 * before.parameters),
            1e-9);
  EXPECT_NEAR(after.standard_error[0] / before.standard_error[0], 16.0, 1e-7);
  EXPECT_NEAR(after.standard_error[1] / before.standard_error[1], 1024.0, 1e-5);
}

TEST_P(EveryEstimator, RefusesAColumnThatTheMotionNeverExcites) {
  auto data = test::seed_data(10.0, 0.05);
  data.phi.col(3).setZero();  // never backwards
  data.dq = data.dq.cwiseAbs();
  try {
    fit(GetParam().name, data);
    FAIL() << "fitted a column of zeros";
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_THAT(error.problems()[0].what, HasSubstr("never excites coulomb_negative"));
    EXPECT_THAT(error.problems()[0].help, HasSubstr("motion in both directions"));
  }
}

TEST_P(EveryEstimator, RefusesUnknownOptions) {
  EXPECT_THROW(fit(GetParam().name, test::seed_data(1.0), {{"lag", std::int64_t{3}}}), Error);
}

TEST_P(EveryEstimator, DescribesItself) {
  EXPECT_EQ(find_estimator(GetParam().name)->title, GetParam().title);
  EXPECT_FALSE(GetParam().source.empty());
  EXPECT_FALSE(GetParam().options.empty());
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryEstimator, testing::ValuesIn(for_any_rows()),
                         [](auto const& choice) { return choice.param.name; });

TEST(Ols, ResidualIsOrthogonalToEveryColumn) {
  auto const data = test::seed_data(20.0, 0.3);
  auto const result = fit("ols", data);
  Eigen::VectorXd const residual = data.tau - data.phi * result.parameters;
  for (Eigen::Index r = 0; r < 4; ++r)
    EXPECT_LT(std::abs(data.phi.col(r).dot(residual)), 1e-13 * data.phi.col(r).norm() * data.tau.norm()) << r;
}

// normal equations in long double by Cramer-free Gaussian elimination: another algorithm, 11 more bits
std::array<double, 4> long_double_oracle(RegressionData const& data) {
  long double a[4][5] = {};
  for (Eigen::Index t = 0; t < data.rows(); ++t)
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) a[i][j] += static_cast<long double>(data.phi(t, i)) * data.phi(t, j);
      a[i][4] += static_cast<long double>(data.phi(t, i)) * data.tau[t];
    }
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 4; ++i) {
      if (i == k) continue;
      long double const factor = a[i][k] / a[k][k];
      for (int j = k; j < 5; ++j) a[i][j] -= factor * a[k][j];
    }
  std::array<double, 4> x{};
  for (std::size_t i = 0; i < 4; ++i) x[i] = static_cast<double>(a[i][4] / a[i][i]);
  return x;
}

TEST(Ols, EqualsLongDoubleElimination) {
  auto const data = test::seed_data(20.0, 0.3);
  auto const oracle = long_double_oracle(data);
  auto const result = fit("ols", data);
  // backward error of QR is relative to the torque, so absolute in each scaled parameter
  for (Eigen::Index r = 0; r < 4; ++r)
    EXPECT_NEAR(result.parameters[r], oracle[static_cast<std::size_t>(r)],
                1e-13 * data.tau.norm() / data.phi.col(r).norm());
}

TEST(Ols, KeepsItsDigitsWhereNormalEquationsLoseThem) {
  // two nearly equal columns, condition 2e7: squared it is beyond double precision's 1e16 / 4
  auto data = test::seed_data(10.0);
  data.phi.col(1) = data.phi.col(0) + 1e-7 * data.phi.col(1);
  Eigen::Vector4d const truth(1.0, 2.0, 3.0, 4.0);
  data.tau = data.phi * truth;
  EXPECT_LT((fit("ols", data).parameters - truth).norm(), 1e-6);
}

TEST(Ols, StatesTheTextbookVariance) {
  // one column of ones: variance of a mean is s^2 / n
  auto const motion = test::multisine(5.0);
  Regressor const regressor({"offset"}, JointKind::revolute);
  auto const data = test::regression_data(motion, regressor, test::white_noise(500, 3, 2.0));
  auto const result = fit("ols", data, {{"hac_lags", std::int64_t{0}}});
  double const s2 = (data.tau.array() - data.tau.mean()).square().sum() / 499.0;
  EXPECT_NEAR(result.parameters[0], data.tau.mean(), 1e-14);
  EXPECT_NEAR(result.covariance_naive(0, 0), s2 / 500.0, 1e-15);
  EXPECT_NEAR(result.covariance_hac(0, 0), s2 / 500.0, 1e-15);  // White is the same for a column of ones
  EXPECT_NEAR(result.ci95(0, 1) - result.parameters[0], 1.959963984540054 * result.standard_error[0], 1e-15);
}

TEST(PredictionMetrics, MeanAndSpreadAddUpToTheMeanSquare) {
  auto const data = test::seed_data(5.0, 0.3);
  Eigen::Vector4d const anything(0.02, -0.1, 0.3, 0.2);
  auto const metrics = prediction_metrics(data, anything);
  EXPECT_NEAR(metrics.mse, metrics.residual_std * metrics.residual_std + metrics.residual_mean * metrics.residual_mean,
              1e-14 * metrics.mse);
  EXPECT_NEAR(metrics.sse, 500.0 * metrics.mse, 1e-12 * metrics.sse);
  EXPECT_NEAR(metrics.relerr, (data.tau - data.phi * anything).norm() / data.tau.norm(), 1e-15);
  EXPECT_EQ(prediction_metrics(data, Eigen::Vector4d::Zero()).relerr, 1.0);
}

// two recordings of the same joint; the second one is `ratio` times as noisy
RegressionData two_recordings(double ratio, std::uint32_t run) {
  Eigen::VectorXd noise = test::white_noise(2000, run, 0.05);
  noise.tail(1000) *= ratio;
  auto data = test::seed_data(20.0, noise);
  data.first_row = {0, 1000, 2000};
  data.recording_names = {"quiet", "noisy"};
  return data;
}

TEST(Wls, OfOneRecordingIsOlsAndSaysSo) {
  auto const data = test::seed_data(10.0, 0.3);
  auto const ols = fit("ols", data), wls = fit("wls", data);
  EXPECT_LT(largest_relative_difference(wls.parameters, ols.parameters), 1e-12);
  EXPECT_LT((wls.standard_error - ols.standard_error).norm(), 1e-12 * ols.standard_error.norm());
  EXPECT_THAT(wls.remark, HasSubstr("wls is ols"));
}

TEST(Wls, WeighsRecordingsByTheInverseOfTheirVariance) {
  auto const result = fit("wls", two_recordings(5.0, 1));
  EXPECT_NEAR(result.weights[0] / result.weights[1999], 25.0, 5.0);  // 1000 samples each: 6 % on a variance ratio
  EXPECT_NEAR(result.weights.mean(), 1.0, 1e-12);
}

TEST(Wls, IsMoreAccurateThanOlsOnUnequalRecordings) {
  double ols = 0.0, wls = 0.0;
  for (std::uint32_t run = 0; run < 40; ++run) {
    auto const data = two_recordings(8.0, run);
    ols += (fit("ols", data).parameters - test::seed_ols).squaredNorm();
    wls += (fit("wls", data).parameters - test::seed_ols).squaredNorm();
  }
  // theory: (1 + 64) / 4 = 16 times the variance for equal excitation; half of that leaves room for 40 draws
  EXPECT_GT(ols, 8.0 * wls);
}

}  // namespace least_squares_test
}  // namespace torquescope
