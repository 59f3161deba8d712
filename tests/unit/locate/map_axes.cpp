#include "engine/infer/locate/map_axes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "unit/locate/synthetic_rows.hpp"

namespace torquescope {
namespace map_axes_test {

std::vector<Eigen::Index> rows_per_cell(std::vector<int> const& cells) {
  std::vector<Eigen::Index> counts(n_map_cells, 0);
  for (int cell : cells) ++counts.at(static_cast<std::size_t>(cell));
  return counts;
}

TEST(MapAxes, EveryRowLiesInTheOneCellThatHoldsIt) {
  auto const made = test::synthetic_rows({1000, 100.0, 8});
  for (SignatureAxis axis : map_axes) {
    if (is_spectrum(axis)) continue;
    Eigen::VectorXd const values = values_on(axis, made.rows);
    auto const edges = cell_edges(axis, values);
    ASSERT_EQ(edges.size(), n_map_cells + 1u) << word(axis);
    EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end())) << word(axis);
    auto const cells = cells_of(values, edges);
    ASSERT_EQ(static_cast<Eigen::Index>(cells.size()), values.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      auto const cell = static_cast<std::size_t>(cells[i]);
      double const value = values[static_cast<Eigen::Index>(i)];
      EXPECT_GE(value, edges[cell]) << word(axis);
      // the end of the axis belongs to its last cell
      EXPECT_TRUE(value < edges[cell + 1] || cell + 1 == n_map_cells) << word(axis);
      EXPECT_LE(value, edges[cell + 1]) << word(axis);
    }
  }
}

TEST(MapAxes, ZeroIsAnEdgeWhereParityMatters) {
  Eigen::VectorXd const uneven = Eigen::VectorXd::LinSpaced(1000, -0.7, 2.1);
  for (SignatureAxis axis : {SignatureAxis::velocity, SignatureAxis::load, SignatureAxis::acceleration}) {
    auto const edges = cell_edges(axis, uneven);
    EXPECT_EQ(std::count(edges.begin(), edges.end(), 0.0), 1);
    EXPECT_EQ(edges.front(), -0.7);
    EXPECT_EQ(edges.back(), 2.1);
  }
}

TEST(MapAxes, OneDirectionOnlyUsesAllCellsForIt) {
  auto const counts =
      rows_per_cell(cells_of(Eigen::VectorXd::LinSpaced(5400, 0.1, 2.0),
                             cell_edges(SignatureAxis::velocity, Eigen::VectorXd::LinSpaced(5400, 0.1, 2.0))));
  for (Eigen::Index count : counts) EXPECT_NEAR(static_cast<double>(count), 100.0, 1.0);
}

TEST(MapAxes, DistancesAreEquallyPopulated) {
  Eigen::VectorXd heavy = Eigen::VectorXd::LinSpaced(5400, 0.0, 3.0).array().exp().square() - 1.0;
  auto const counts = rows_per_cell(cells_of(heavy, cell_edges(SignatureAxis::since_velocity_reversal, heavy)));
  for (Eigen::Index count : counts) EXPECT_NEAR(static_cast<double>(count), 100.0, 1.0);
}

TEST(MapAxes, TiedDistancesStayTogether) {
  Eigen::VectorXd tied = Eigen::VectorXd::Zero(600);
  tied.tail(300).setLinSpaced(0.1, 1.0);
  auto const cells = cells_of(tied, cell_edges(SignatureAxis::since_torque_reversal, tied));
  for (std::size_t i = 0; i < 300; ++i) EXPECT_EQ(cells[i], cells[0]);
  for (std::size_t i = 300; i < 600; ++i) EXPECT_NE(cells[i], cells[0]);
}

TEST(MapAxes, AConstantAxisHasAllItsRowsInOneCell) {
  for (SignatureAxis axis : {SignatureAxis::load, SignatureAxis::position, SignatureAxis::since_torque_reversal}) {
    Eigen::VectorXd const constant = Eigen::VectorXd::Constant(100, 0.4);
    auto const counts = rows_per_cell(cells_of(constant, cell_edges(axis, constant)));
    EXPECT_EQ(std::count(counts.begin(), counts.end(), 0), n_map_cells - 1) << word(axis);
  }
}

TEST(MapAxes, ARowWithoutAPlaceIsInNoCell) {
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);
  values[7] = std::numeric_limits<double>::quiet_NaN();
  auto const cells = cells_of(values, cell_edges(SignatureAxis::position, values));
  EXPECT_EQ(cells[7], -1);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), -1), 1);
}

TEST(MapAxes, LoadIsThatAlongTheMotion) {
  auto const made = test::synthetic_rows({400, 100.0, 8});
  Eigen::VectorXd const load = values_on(SignatureAxis::load, made.rows);
  for (Eigen::Index i = 0; i < load.size(); ++i)
    EXPECT_EQ(load[i], std::copysign(1.0, made.rows.dq[i]) * made.rows.load_torque[i]);
}

}  // namespace map_axes_test
}  // namespace torquescope
