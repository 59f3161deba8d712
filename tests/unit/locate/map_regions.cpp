#include "engine/infer/locate/map_regions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace map_regions_test {

constexpr int n_cells = 30;

std::vector<double> edges() {
  std::vector<double> result(n_cells + 1);
  std::iota(result.begin(), result.end(), 0.0);
  return result;
}

Eigen::MatrixXd normals(Eigen::Index replicates, std::uint32_t set) {
  Eigen::MatrixXd values(n_cells, replicates + 1);
  RandomStream stream({31, set, RandomDomain::test}, 0, 0);
  for (double& value : values.reshaped()) value = stream.normal();
  return values;
}

std::vector<CellRun> runs_of(Eigen::MatrixXd const& values, Tail tail = Tail::both) {
  std::vector<CellScores> const scores{score_cells(values)};
  return unusual_runs(scores, edges(), tail);
}

TEST(UnusualRuns, CleanRecordingsHaveOneInTwentyTimes) {
  // four binomial standard errors
  int constexpr sets = 1000;
  for (Tail tail : {Tail::both, Tail::upper}) {
    int with_any = 0;
    for (std::uint32_t set = 0; set < sets; ++set) with_any += runs_of(normals(99, set), tail).empty() ? 0 : 1;
    EXPECT_NEAR(with_any, 0.05 * sets, 4.0 * std::sqrt(sets * 0.05 * 0.95));
  }
}

TEST(UnusualRuns, GrowFromASeedOverWeakerCellsOfTheSameSign) {
  Eigen::MatrixXd values = normals(200, 7);
  values.col(0).setZero();
  values.col(0).segment(10, 5) << 3.0, 3.0, 9.0, 3.0, -9.0;
  auto const runs = runs_of(values);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].first, 10);
  EXPECT_EQ(runs[0].last, 13);
  EXPECT_EQ(runs[1].first, 14);
  EXPECT_EQ(runs[1].last, 14);
}

TEST(UnusualRuns, WeakCellsAloneAreNone) {
  Eigen::MatrixXd values = normals(200, 8);
  values.col(0).setConstant(2.3);  // beyond the pointwise level, not beyond the largest of thirty
  EXPECT_TRUE(runs_of(values).empty());
}

TEST(UnusualRuns, BelowTheReplicatesIsNothingInASpectrum) {
  Eigen::MatrixXd values = normals(200, 9);
  values.col(0).setZero();
  values(4, 0) = -12.0;
  EXPECT_TRUE(runs_of(values, Tail::upper).empty());
  EXPECT_EQ(runs_of(values, Tail::both).size(), 1u);
}

TEST(UnusualRuns, FewerThanNineteenReplicatesCarryNoClaim) {
  for (Eigen::Index replicates : {8, 18, 19}) {
    Eigen::MatrixXd values = normals(replicates, 10);
    values(4, 0) = 1e3;
    EXPECT_EQ(runs_of(values).empty(), replicates < 19);
  }
}

TEST(UnusualRuns, EmptyCellsEndARunUnlessTheyHaveNoWidth) {
  double const none = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd values = normals(200, 11);
  values.col(0).setZero();
  values.col(0).segment(10, 3).setConstant(9.0);
  values.row(11).setConstant(none);
  EXPECT_EQ(runs_of(values).size(), 2u);
  auto tied = edges();
  tied[12] = tied[11];
  std::vector<CellScores> const scores{score_cells(values)};
  auto const runs = unusual_runs(scores, tied, Tail::both);
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].first, 10);
  EXPECT_EQ(runs[0].last, 12);
}

TEST(UnusualRuns, OverlappingRunsOfTwoReadingsAreOne) {
  Eigen::MatrixXd one = normals(200, 12), other = normals(200, 13);
  one.col(0).setZero();
  other.col(0).setZero();
  one.col(0).segment(5, 4).setConstant(9.0);
  other.col(0).segment(7, 4).setConstant(-9.0);
  std::vector<CellScores> const scores{score_cells(one), score_cells(other)};
  auto const runs = unusual_runs(scores, edges(), Tail::both);
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].first, 5);
  EXPECT_EQ(runs[0].last, 10);
}

}  // namespace map_regions_test
}  // namespace torquescope
