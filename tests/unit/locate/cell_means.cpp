#include "engine/infer/locate/cell_means.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/locate/synthetic_rows.hpp"

namespace torquescope {
namespace cell_means_test {

CellSums sums_over_position(MismatchRows const& rows, int threads = 1) {
  auto const cells = cells_of(rows.q, cell_edges(SignatureAxis::position, rows.q));
  return sum_in_cells(rows, cells, n_map_cells, CellReading::torque, threads);
}

TEST(CellSums, CountEveryRowOnItsSide) {
  MismatchRows const rows = test::synthetic_rows({1500, 100.0, 12}).rows;
  CellSums const sums = sums_over_position(rows);
  EXPECT_EQ(sums.forward_rows.sum(), static_cast<double>((rows.dq.array() > 0.0).count()));
  EXPECT_EQ(sums.rows().sum(), static_cast<double>(rows.size()));
  EXPECT_NEAR(sums.energy.sum(), rows.residual.squaredNorm(), 1e-9);
  EXPECT_NEAR((sums.forward + sums.backward).col(0).sum(), rows.residual.sum(), 1e-9);
  EXPECT_NEAR((sums.forward + sums.backward).col(12).sum(), rows.replicates.col(11).sum(), 1e-9);
}

TEST(CellMeans, OfAnOddResidualShowOnlyAlongTheMotion) {
  MismatchRows rows = test::synthetic_rows({1500, 100.0, 12}).rows;
  rows.residual = rows.dq.array().sign();
  CellSums const sums = sums_over_position(rows);
  Eigen::MatrixXd const along = cell_means(sums, CellReading::along_motion);
  Eigen::MatrixXd const plain = cell_means(sums, CellReading::torque);
  for (Eigen::Index cell = 0; cell < n_map_cells; ++cell) {
    if (sums.rows()[cell] == 0.0) {
      EXPECT_TRUE(std::isnan(along(cell, 0)));
      continue;
    }
    EXPECT_DOUBLE_EQ(along(cell, 0), 1.0);
    EXPECT_NEAR(plain(cell, 0), (sums.forward_rows[cell] - sums.backward_rows[cell]) / sums.rows()[cell], 1e-12);
  }
}

TEST(CellEnergies, OfWhatIsConstantInACellAreAllOfIt) {
  MismatchRows rows = test::synthetic_rows({1500, 100.0, 12}).rows;
  rows.replicates.setZero();
  rows.residual = rows.dq.array().sign() + 0.5;  // one constant for either direction
  CellSums const sums = sums_over_position(rows);
  EXPECT_NEAR(two_sided_energies(sums).col(0).sum(), rows.residual.squaredNorm(), 1e-9);
  EXPECT_LT(cell_energies(sums, CellReading::torque).col(0).sum(), 0.6 * rows.residual.squaredNorm());
}

TEST(CellEnergies, OfACleanRecordingAndOfAReplicateAreEqualOnAverage) {
  // few replicates, where a replicate's part in their mean counts most
  constexpr Eigen::Index cells = 50, replicates = 8;
  constexpr std::uint32_t sets = 2000;
  double recording = 0.0, replicate = 0.0;
  for (std::uint32_t set = 0; set < sets; ++set) {
    RandomStream stream({5, set, RandomDomain::test}, 0, 0);
    CellSums sums;
    sums.forward_rows = Eigen::VectorXd::Ones(cells);
    sums.backward_rows = Eigen::VectorXd::Zero(cells);
    sums.forward.resize(cells, replicates + 1);
    sums.backward = Eigen::MatrixXd::Zero(cells, replicates + 1);
    for (double& value : sums.forward.reshaped()) value = stream.normal();
    Eigen::MatrixXd const energies = cell_energies(sums, CellReading::torque);
    recording += energies.col(0).sum();
    replicate += energies.rightCols(replicates).sum() / replicates;
  }
  // each is a mean over 1e5 chi-square draws: relative standard error 0.5 % at most
  double constexpr expected = (1.0 + 1.0 / replicates) * cells * sets;
  EXPECT_NEAR(recording / expected, 1.0, 0.02);
  EXPECT_NEAR(replicate / expected, 1.0, 0.02);
}

}  // namespace cell_means_test
}  // namespace torquescope
