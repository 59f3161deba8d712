#include "engine/experiment/runs/run_summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace torquescope {
namespace run_summary_test {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

TEST(Median, OfOddAndEvenCounts) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 3.0}), 2.5);
  EXPECT_TRUE(std::isnan(median({1.0, not_a_number, 2.0})));
}

TEST(StandardDeviation, IsZeroForOneRunAndUnbiasedForMore) {
  EXPECT_EQ(standard_deviation({5.0}), 0.0);
  EXPECT_DOUBLE_EQ(standard_deviation({1.0, 2.0, 3.0, 4.0}), std::sqrt(5.0 / 3.0));
}

TEST(LowerMedianIndex, NamesARunThatExists) {
  EXPECT_EQ(lower_median_index({9.0, 1.0, 5.0}), 2u);
  EXPECT_EQ(lower_median_index({4.0, 1.0, 2.0, 3.0}), 2u);
  EXPECT_EQ(lower_median_index({7.0, 7.0, 7.0}), 1u);
  EXPECT_EQ(lower_median_index({not_a_number, 1.0, 2.0}), 2u);  // NaN sorts last
}

TEST(Mean, AveragesRuns) {
  Eigen::VectorXd const a = Eigen::Vector2d(1.0, 2.0), b = Eigen::Vector2d(3.0, -2.0);
  EXPECT_EQ(mean({a, b}), Eigen::VectorXd(Eigen::Vector2d(2.0, 0.0)));
}

}  // namespace run_summary_test
}  // namespace torquescope
