// The seed's regressor is found to have two columns that are constant by direction of motion, and sorting changes
// rounding only.
#include "engine/fit/problem/levelled_recording.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace levelled_recording_test {

std::vector<double> levelled_energies(LevelledRecording const& recording, std::vector<double> const& rows) {
  auto const tiles = recording.tiles();
  std::vector<double> energy(rows.size() / 4);
  kernels::AlignedDoubles workspace(kernels::levelled_workspace_size(tiles, energy.size()));
  kernels::levelled_residual_energy(tiles, {rows.data(), energy.size(), 4}, energy.data(), workspace.data());
  return energy;
}

std::vector<double> random_rows(std::size_t members) {
  RandomStream random({8, 0, RandomDomain::test}, 0, 0);
  std::vector<double> rows(4 * members);
  for (auto& x : rows) x = random.uniform(-1.0, 1.0);
  return rows;
}

void expect_plain_loops(RegressionData const& data, LevelledRecording const& recording) {
  auto const rows = random_rows(13);
  auto const energy = levelled_energies(recording, rows);
  for (std::size_t m = 0; m < energy.size(); ++m) {
    long double sum = 0;
    for (Eigen::Index t = 0; t < data.rows(); ++t) {
      long double e = static_cast<long double>(data.tau[t]);
      for (Eigen::Index r = 0; r < 4; ++r)
        e -= static_cast<long double>(data.phi(t, r)) *
             static_cast<long double>(rows[4 * m + static_cast<std::size_t>(r)]);
      sum += e * e;
    }
    // some 1e-16 of each residual, averaged over thousands
    EXPECT_NEAR(energy[m], static_cast<double>(sum), 1e-14 * static_cast<double>(sum));
  }
}

TEST(LevelledRecording, SortsTheSeedsRegressorByDirection) {
  auto const data = test::seed_data(30.01, 0.3);
  auto const recording = LevelledRecording::make(data.phi, data.tau);
  ASSERT_TRUE(recording.has_value());
  auto const tiles = recording->tiles();
  EXPECT_EQ(tiles.n_constant, 2u);
  EXPECT_EQ(tiles.varying.n_regressors, 2u);
  EXPECT_EQ(tiles.n_runs, 2u);
  EXPECT_EQ(tiles.varying.n_samples + tiles.rest.n_samples, 3001u);
  expect_plain_loops(data, *recording);
}

TEST(LevelledRecording, GivesRestARunOfItsOwn) {
  auto data = test::seed_data(30.01, 0.3);
  for (Eigen::Index t = 500; t < 700; ++t) data.phi(t, 2) = data.phi(t, 3) = 0.0;
  auto const recording = LevelledRecording::make(data.phi, data.tau);
  ASSERT_TRUE(recording.has_value());
  EXPECT_EQ(recording->tiles().n_runs, 3u);
  expect_plain_loops(data, *recording);
}

TEST(LevelledRecording, IsNotMadeOfFilteredColumns) {
  auto data = test::seed_data(30.01, 0.3);
  // what a filter does to a step
  for (Eigen::Index t = 1; t < data.rows(); ++t) data.phi(t, 2) += 0.5 * (data.phi(t - 1, 2) - data.phi(t, 2));
  EXPECT_FALSE(LevelledRecording::make(data.phi, data.tau).has_value());
}

TEST(LevelledRecording, IsNotMadeOfAShortOneNorOfOneConstantColumn) {
  auto const short_one = test::seed_data(20.47, 0.3);
  EXPECT_FALSE(LevelledRecording::make(short_one.phi, short_one.tau).has_value());
  auto const data = test::seed_data(30.0, 0.3);
  EXPECT_FALSE(LevelledRecording::make(data.phi.leftCols(3), data.tau).has_value());
}

TEST(LevelledRecording, LeavesManyCombinationsAlone) {
  auto data = test::seed_data(30.0, 0.3);
  data.phi.conservativeResize(Eigen::NoChange, 7);
  // 3 x 3 x 3 combinations
  for (Eigen::Index t = 0; t < data.rows(); ++t)
    for (Eigen::Index c = 4, step = 1; c < 7; ++c, step *= 3) data.phi(t, c) = static_cast<double>(t / step % 3);
  EXPECT_FALSE(LevelledRecording::make(data.phi, data.tau).has_value());
}

}  // namespace levelled_recording_test
}  // namespace torquescope
