#include "engine/fit/statistics/essential_parameters.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/decompositions.hpp"

namespace torquescope {
namespace essential_parameters_test {

struct Rows {
  Eigen::MatrixXd phi;
  Eigen::VectorXd tau;

  Eigen::MatrixXd gram() const {
    Eigen::MatrixXd both(phi.rows(), phi.cols() + 1);
    both << phi, tau;
    return both.transpose() * both;
  }
};

Rows rows_of(Eigen::VectorXd const& truth, double noise) {
  std::mt19937 bits(11);
  std::normal_distribution<double> normal;
  Rows rows;
  rows.phi = Eigen::MatrixXd::NullaryExpr(400, truth.size(), [&](Eigen::Index, Eigen::Index) { return normal(bits); });
  rows.tau = rows.phi * truth + noise * Eigen::VectorXd::NullaryExpr(400, [&](Eigen::Index) { return normal(bits); });
  return rows;
}

TEST(EssentialParameters, AreThoseWithAnEffect) {
  Eigen::VectorXd truth(6);
  truth << 3.0, 0.0, -2.0, 1e-4, 1.0, 0.0;
  auto const rows = rows_of(truth, 0.5);
  auto const found = essential_parameters(rows.gram(), 400, usual_essential_ratio);
  EXPECT_EQ(found.kept, (std::vector<Eigen::Index>{0, 2, 4}));
  EXPECT_EQ(found.dropped.size(), 3u);
  // the fit is that of the kept columns alone
  Eigen::MatrixXd const kept = rows.phi(Eigen::all, found.kept);
  EXPECT_LT((found.values - test::least_squares(kept, rows.tau)).norm(), 1e-10);
  EXPECT_NEAR(found.residual_energy, test::left_beside(kept, rows.tau).squaredNorm(), 1e-9 * rows.tau.squaredNorm());
  EXPECT_NEAR(found.standard_errors[0], 0.5 / 20.0, 0.005);
}

TEST(EssentialParameters, OfAWideRatioAreAll) {
  Eigen::VectorXd truth(3);
  truth << 1.0, 2.0, 3.0;
  auto const found = essential_parameters(rows_of(truth, 0.1).gram(), 400, usual_essential_ratio);
  EXPECT_EQ(found.kept.size(), 3u);
  EXPECT_TRUE(found.dropped.empty());
}

TEST(EssentialParameters, DropDependentAndEmptyColumnsFirst) {
  Eigen::VectorXd truth(4);
  truth << 1.0, 2.0, 0.0, 3.0;
  auto rows = rows_of(truth, 0.1);
  rows.phi.col(2) = rows.phi.col(0) + rows.phi.col(1);
  auto found = essential_parameters(rows.gram(), 400, usual_essential_ratio);
  EXPECT_EQ(found.dropped, (std::vector<Eigen::Index>{2}));
  rows.phi.col(2).setZero();
  found = essential_parameters(rows.gram(), 400, usual_essential_ratio);
  EXPECT_EQ(found.dropped, (std::vector<Eigen::Index>{2}));
  EXPECT_EQ(found.kept, (std::vector<Eigen::Index>{0, 1, 3}));
}

}  // namespace essential_parameters_test
}  // namespace torquescope
