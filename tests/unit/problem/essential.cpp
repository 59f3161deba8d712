// The estimator of essential parameters: what nothing moves goes, what is left is least squares of it.

#include <gtest/gtest.h>

#include <cmath>

#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace essential_test {

using test::fit;

// a fifth parameter that the torque does not have
RegressionData with_idle_column() {
  auto data = test::seed_data(20.0, 0.002);
  data.phi.conservativeResize(Eigen::NoChange, 5);
  data.phi.col(4) = data.q.array().cos();
  data.columns.push_back({"idle", "N m"});
  data.same_columns = {};
  return data;
}

TEST(Essential, LeavesOutWhatTheTorqueDoesNotHave) {
  auto const data = with_idle_column();
  auto const all = fit("ols", data), few = fit("essential", data);
  ASSERT_LT(std::abs(all.parameters[4]), 4.0 * all.standard_error[4]);
  EXPECT_EQ(few.parameters[4], 0.0);
  EXPECT_TRUE(std::isnan(few.standard_error[4]));
  EXPECT_TRUE(std::isnan(few.ci95(4, 0)));
  EXPECT_EQ(few.covariance_hac.row(4).norm(), 0.0);
}

TEST(Essential, FitsTheRestAsLeastSquaresOfThemAlone) {
  auto const alone = fit("ols", test::seed_data(20.0, 0.002)), few = fit("essential", with_idle_column());
  EXPECT_LT((few.parameters.head(4) - alone.parameters).norm(), 1e-12);
  EXPECT_LT((few.standard_error.head(4) - alone.standard_error).norm(), 1e-10 * alone.standard_error.norm());
}

TEST(Essential, WithAWideRatioIsOls) {
  auto const data = with_idle_column();
  auto const all = fit("ols", data), wide = fit("essential", data, {{"ratio", 1e6}});
  EXPECT_LT((wide.parameters - all.parameters).norm(), 1e-12);
  EXPECT_LT((wide.standard_error - all.standard_error).norm(), 1e-10 * all.standard_error.norm());
}

}  // namespace essential_test
}  // namespace torquescope
