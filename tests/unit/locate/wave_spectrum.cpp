#include "engine/infer/locate/wave_spectrum.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "engine/infer/locate/map_axes.hpp"
#include "engine/infer/locate/wave_cells.hpp"
#include "support/decompositions.hpp"
#include "unit/locate/synthetic_rows.hpp"

namespace torquescope {
namespace wave_spectrum_test {

constexpr double two_pi = 2.0 * std::numbers::pi;

double explained(Eigen::VectorXd const& x, Eigen::VectorXd const& phase) {
  Eigen::MatrixXd columns(x.size(), 2);
  columns << phase.array().cos().matrix(), phase.array().sin().matrix();
  Eigen::VectorXd const left = test::left_beside(columns, x);
  return x.squaredNorm() - left.squaredNorm();
}

TEST(WaveSpectrum, EqualsLeastSquaresAtEveryFrequencyInSpiteOfGaps) {
  auto const made = test::synthetic_rows({700, 100.0, 9, 0.6});
  MismatchRows const& rows = made.rows;
  ASSERT_LT(rows.size(), 700);  // there are gaps
  WaveGrid const grid = time_waves(rows, 40.0);
  std::vector<WaveBand> bands;
  for (Eigen::Index wave = grid.first; wave <= grid.last; wave += 37) bands.push_back({wave, wave});
  Eigen::MatrixXd const energies = band_energies(rows, grid, bands, 1) * grid.overlap();
  double const factor = 10.0 / 8.0;  // (M + 1) / (M - 1)
  for (std::size_t i = 0; i < bands.size(); ++i) {
    double const hz = grid.spacing * static_cast<double>(bands[i].first);
    Eigen::VectorXd const phase = two_pi * hz * rows.time_s;
    auto const row = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(energies(row, 0), explained(rows.residual - rows.replicate_mean, phase), 1e-8) << hz;
    EXPECT_NEAR(energies(row, 9), factor * explained(rows.replicates.col(8) - rows.replicate_mean, phase), 1e-8) << hz;
  }
}

TEST(WaveSpectrum, EqualsLeastSquaresInPositionUpToItsGrid) {
  auto made = test::synthetic_rows({2000, 100.0, 8});
  MismatchRows& rows = made.rows;
  WaveGrid const grid = position_waves(rows, 60.0);
  // no noise: what the grid loses of a wave must be seen
  rows.replicate_mean.setZero();
  for (Eigen::Index wave : {grid.first, (grid.first + grid.last) / 2, grid.last}) {
    double const order = grid.spacing * static_cast<double>(wave);
    rows.residual = (order * rows.q.array() + 0.3).cos();
    double const energy = band_energies(rows, grid, {{wave, wave}}, 1)(0, 0) * grid.overlap();
    double const lost = 1.0 - energy / rows.residual.squaredNorm();
    EXPECT_GE(lost, -1e-12);
    double const half = std::numbers::pi / 8.0 * order / 60.0;  // half a point of the grid, as a phase
    EXPECT_NEAR(lost, 1.0 - std::pow(std::sin(half) / half, 2), 0.02) << order;
  }
}

TEST(WaveSpectrum, ALineKeepsItsEnergyInItsWindow) {
  auto made = test::synthetic_rows({3000, 100.0, 8});
  MismatchRows& rows = made.rows;
  rows.replicate_mean.setZero();
  rows.residual = (two_pi * 7.13 * rows.time_s.array()).sin();
  WaveGrid const grid = time_waves(rows, 40.0);
  auto const windows = third_octaves(grid);
  double const best = band_energies(rows, grid, windows, 1).col(0).maxCoeff();
  EXPECT_NEAR(best / rows.residual.squaredNorm(), 1.0, 0.05);  // gaps leak a few per cent
}

TEST(WaveCells, HoldEveryWaveOnce) {
  auto const made = test::synthetic_rows({3000, 100.0, 8});
  for (double highest : {40.0, 2.0, 0.3}) {
    WaveGrid const grid = time_waves(made.rows, highest);
    auto const edges = wave_edges(grid);
    ASSERT_EQ(edges.size(), n_map_cells + 1u);
    auto const bands = waves_in(grid, edges);
    Eigen::Index next = grid.first;
    for (WaveBand const& band : bands) {
      EXPECT_EQ(band.first, next);
      EXPECT_GE(band.waves(), 0);
      next = band.last + 1;
    }
    EXPECT_EQ(next, grid.last + 1);
  }
}

TEST(WaveCells, AreNeverEmptyWhenThereAreWavesEnough) {
  auto const made = test::synthetic_rows({3000, 100.0, 8});
  WaveGrid const grid = time_waves(made.rows, 40.0);
  ASSERT_GT(grid.last - grid.first, 54);
  for (WaveBand const& band : waves_in(grid, wave_edges(grid))) EXPECT_GE(band.waves(), 1);
}

TEST(WaveSpectrum, AJointThatStandsStillHasNoOrders) {
  auto made = test::synthetic_rows({300, 100.0, 8});
  made.rows.q.setConstant(0.5);
  WaveGrid const grid = position_waves(made.rows, 60.0);
  EXPECT_LT(grid.last, grid.first);
  EXPECT_TRUE(third_octaves(grid).empty());
  for (WaveBand const& band : waves_in(grid, wave_edges(grid))) EXPECT_EQ(band.waves(), 0);
}

}  // namespace wave_spectrum_test
}  // namespace torquescope
