#include "engine/fit/problem/hac.hpp"

#include <gmock/gmock.h>

#include <Eigen/Core>

#include "support/decompositions.hpp"
#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace hac_test {

using test::fit;

constexpr std::uint32_t n_draws = 400;

struct Coverage {
  Eigen::Array4d hac = Eigen::Array4d::Zero();  // share of draws whose interval holds the truth, by parameter
  Eigen::Array4d naive = Eigen::Array4d::Zero();
};

Coverage coverage_of(double rho) {
  auto data = test::seed_data(20.0);
  Eigen::VectorXd const clean = data.tau;
  Coverage share;
  for (std::uint32_t run = 0; run < n_draws; ++run) {
    data.tau = clean + test::autoregressive_noise(2000, run, 0.3, rho);
    auto const result = fit("ols", data);
    for (Eigen::Index r = 0; r < 4; ++r) {
      double const error = std::abs(result.parameters[r] - test::seed_ols[r]);
      share.hac[r] +=
          (test::seed_ols[r] >= result.ci95(r, 0) && test::seed_ols[r] <= result.ci95(r, 1)) / double(n_draws);
      share.naive[r] += (error <= 1.96 * result.standard_error_naive[r]) / double(n_draws);
    }
  }
  return share;
}

TEST(HacIntervals, CoverAutocorrelatedNoiseWhereNaiveOnesDoNot) {
  auto const share = coverage_of(0.9);
  // measured: 93 to 95 % against 45 to 50 %
  for (Eigen::Index r = 0; r < 4; ++r) {
    EXPECT_GE(share.hac[r], 0.88) << "parameter " << r;
    EXPECT_LE(share.hac[r], 0.98) << "parameter " << r;
  }
  EXPECT_LT(share.naive.maxCoeff(), 0.65);
}

TEST(HacIntervals, CoverWhiteNoiseLikeNaiveOnes) {
  auto const share = coverage_of(0.0);
  // binomial deviation of 400 draws at 95 %: 1.1 %, three of them
  for (Eigen::Index r = 0; r < 4; ++r) {
    EXPECT_NEAR(share.hac[r], 0.95, 0.033) << "parameter " << r;
    EXPECT_NEAR(share.naive[r], 0.95, 0.033) << "parameter " << r;
  }
}

TEST(HacErrors, EqualNaiveOnesWhenResidualsAreWhite) {
  auto const result = fit("ols", test::seed_data(200.0, 0.3));
  for (Eigen::Index r = 0; r < 4; ++r)
    EXPECT_NEAR(result.standard_error[r] / result.standard_error_naive[r], 1.0, 0.06) << r;
  EXPECT_LE(result.hac_lags, 3);
}

TEST(NeweyWest, OfNoLagsIsWhite) {
  auto const data = test::seed_data(5.0, 0.3);
  Eigen::VectorXd const residual = data.tau - data.phi * fit("ols", data).parameters;
  auto const bread = inverse_information(data, {});
  Eigen::MatrixXd const scores = residual.asDiagonal() * data.phi;
  Eigen::Matrix4d meat = Eigen::Matrix4d::Zero();
  for (Eigen::Index t = 0; t < 500; ++t) meat += scores.row(t).transpose() * scores.row(t);
  Eigen::MatrixXd const white = 500.0 / 496.0 * bread * meat * bread;
  EXPECT_LT((newey_west_covariance({data.phi, residual, data.first_row}, bread, 0) - white).norm(),
            1e-12 * white.norm());
}

TEST(NeweyWest, EqualsTheDoubleSumOverAllPairs) {
  auto const data = test::seed_data(1.0, 0.3);
  Eigen::MatrixXd const scores = data.tau.asDiagonal() * data.phi;
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(4, 4);
  for (Eigen::Index s = 0; s < 100; ++s)
    for (Eigen::Index t = 0; t < 100; ++t)
      meat +=
          std::max(0.0, 1.0 - std::abs(static_cast<double>(s - t)) / 8.0) * scores.row(s).transpose() * scores.row(t);
  Eigen::MatrixXd const covariance =
      newey_west_covariance({data.phi, data.tau, data.first_row}, Eigen::MatrixXd::Identity(4, 4), 7);
  EXPECT_LT((covariance - 100.0 / 96.0 * meat).norm(), 1e-12 * meat.norm());
}

TEST(NeweyWest, OfManyBlocksIsThatOfAllRowsAtOnce) {
  // 20000 rows are three blocks; two recordings, so that blocks end at a border and inside
  auto const data = test::seed_data(200.0, 0.3);
  std::vector<Eigen::Index> const first_row{0, 9000, 20000};
  Eigen::MatrixXd const scores = data.tau.asDiagonal() * data.phi;
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(4, 4);
  for (Eigen::Index lag = 0; lag <= 30; ++lag) {
    double const weight = 1.0 - static_cast<double>(lag) / 31.0;
    for (std::size_t k = 0; k < 2; ++k) {
      auto const rows = first_row[k + 1] - first_row[k] - lag;
      Eigen::MatrixXd const product =
          scores.middleRows(first_row[k] + lag, rows).transpose() * scores.middleRows(first_row[k], rows);
      meat += lag == 0 ? product : weight * (product + product.transpose());
    }
  }
  auto const covariance = newey_west_covariance({data.phi, data.tau, first_row}, Eigen::MatrixXd::Identity(4, 4), 30);
  EXPECT_LT((covariance - 20000.0 / 19996.0 * meat).norm(), 1e-12 * meat.norm());
}

TEST(NeweyWest, IsPositiveSemidefinite) {
  auto const data = test::seed_data(2.0, 0.3);
  auto const result = fit("ols", data, {{"hac_lags", std::int64_t{60}}});
  Eigen::VectorXd const values = test::eigenvalues(result.covariance_hac);
  EXPECT_GT(values.minCoeff(), -1e-12 * values.maxCoeff());
}

TEST(NeweyWest, NeverPairsRowsOfTwoRecordings) {
  // one recording cut in two: the pairs across the cut go, so exchanging the recordings changes nothing
  auto const data = test::seed_data(2.0, 0.3);
  Eigen::MatrixXd exchanged(200, 4);
  exchanged << data.phi.bottomRows(80), data.phi.topRows(120);
  Eigen::VectorXd psi(200);
  psi << data.tau.tail(80), data.tau.head(120);
  auto const covariance = [](Eigen::MatrixXd const& phi, Eigen::VectorXd const& tau,
                             std::vector<Eigen::Index> const& first_row) {
    return newey_west_covariance({phi, tau, first_row}, Eigen::MatrixXd::Identity(4, 4), 9);
  };
  auto const before = covariance(data.phi, data.tau, {0, 120, 200});
  EXPECT_LT((covariance(exchanged, psi, {0, 80, 200}) - before).norm(), 1e-13 * before.norm());
  EXPECT_GT((covariance(data.phi, data.tau, {0, 200}) - before).norm(), 1e-6 * before.norm());
}

TEST(AndrewsLags, GrowWithTheMemoryOfTheNoise) {
  auto const lags = [](double rho) {
    return fit("ols", test::seed_data(20.0, test::autoregressive_noise(2000, 0, 0.3, rho))).hac_lags;
  };
  EXPECT_LE(lags(0.0), 4);
  EXPECT_GT(lags(0.9), lags(0.5));
  EXPECT_GT(lags(0.5), lags(0.0));
}

TEST(AndrewsLags, AgreeWithTheFormulaForAnAutoregression) {
  // rho = 0.9, n = 20000: 1.1447 (4 rho^2 / (1 - rho^2)^2 n)^(1/3) = 139.6
  auto const noise = test::autoregressive_noise(20000, 5, 1.0, 0.9);
  EXPECT_NEAR(static_cast<double>(andrews_lags({noise, Eigen::VectorXd::Ones(20000), {0, 20000}})), 138.6, 6.0);
}

TEST(CriticalValue, IsNormalForShortMemoryAndWiderForLong) {
  EXPECT_NEAR(critical_value(0, 1000), 1.96, 1e-4);
  EXPECT_NEAR(critical_value(99, 1000), 2.2605, 1e-3);
  // by simulation of 40000 Gaussian series of 500: 2.007, 2.248, 2.834 at b = 0.02, 0.1, 0.3
  EXPECT_NEAR(critical_value(9, 500), 2.007, 0.03);
  EXPECT_NEAR(critical_value(49, 500), 2.248, 0.03);
  EXPECT_NEAR(critical_value(149, 500), 2.834, 0.05);
}

}  // namespace hac_test
}  // namespace torquescope
