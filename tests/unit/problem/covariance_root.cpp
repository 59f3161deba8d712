// Errors as independent parts have the covariance they came from, and the largest of them are kept.

#include "engine/fit/problem/covariance_root.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace torquescope {
namespace covariance_root_test {

Eigen::MatrixXd covariance() {
  Eigen::MatrixXd mixing(4, 4);
  // units of very different sizes, and the last parameter without any error
  mixing << 1e3, 2e2, -5e2, 0.0, 0.1, 0.4, 0.2, 0.0, -2e-4, 1e-4, 3e-4, 0.0, 0.0, 0.0, 0.0, 0.0;
  return mixing * mixing.transpose();
}

TEST(CovarianceRoot, TimesItselfIsTheCovariance) {
  Eigen::MatrixXd const root = covariance_root(covariance());
  Eigen::MatrixXd const again = root * root.transpose();
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = 0; j < 4; ++j)
      EXPECT_NEAR(again(i, j), covariance()(i, j), 1e-9 * std::sqrt(covariance()(i, i) * covariance()(j, j))) << i << j;
}

TEST(LargestParts, KeepTheSpreadOfEveryRow) {
  Eigen::MatrixXd const columns = Eigen::MatrixXd::Random(50, 4);
  Eigen::MatrixXd const parts = largest_parts(columns, 0.0);
  EXPECT_LT((parts * parts.transpose() - columns * columns.transpose()).norm(), 1e-10);
}

TEST(LargestParts, DropWhatIsSmallerThanAsked) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(100, 3);
  columns.col(0).setConstant(2.0);
  columns.col(1).head(50).setConstant(0.1);
  columns.col(1).tail(50).setConstant(-0.1);
  columns.col(2).setConstant(0.5);  // along the first
  Eigen::MatrixXd const parts = largest_parts(columns, 0.5);
  ASSERT_EQ(parts.cols(), 1);
  EXPECT_NEAR(parts.col(0).squaredNorm(), 100.0 * (4.0 + 0.25), 1e-6);
  EXPECT_EQ(largest_parts(columns, 10.0).cols(), 0);
  EXPECT_EQ(largest_parts(Eigen::MatrixXd(100, 0), 0.5).cols(), 0);
}

}  // namespace covariance_root_test
}  // namespace torquescope
