// What a law leaves beyond noise may hide among its own columns as well, and then moves their coefficients so far and
// no further.

#include "engine/infer/search/law_discrepancy.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

#include "engine/base/dense_solvers.hpp"
#include "support/decompositions.hpp"

using namespace torquescope;

namespace law_discrepancy_test {

constexpr Eigen::Index n = 60, k = 4;

MismatchEnergy left(double excess, double z) {
  MismatchEnergy energy;
  energy.excess = excess;
  energy.z = z;
  return energy;
}

Eigen::MatrixXd normal_numbers(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

CoefficientBounds everywhere() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {Eigen::VectorXd::Constant(k, -infinity), Eigen::VectorXd::Constant(k, infinity)};
}

TEST(LawDiscrepancy, IsNoneWhereWhatIsLeftMayBeChance) {
  Eigen::MatrixXd const columns = normal_numbers(n, k, 1);
  for (auto const& chance : {left(5.0, 1.6), left(-5.0, 3.0), left(0.0, 0.0)})
    EXPECT_EQ(discrepancy_shifts(chance, columns, everywhere()), Eigen::VectorXd::Zero(k));
}

TEST(LawDiscrepancy, GrowsFromNoneAsWhatIsLeftBecomesSure) {
  Eigen::MatrixXd const columns = normal_numbers(n, k, 1);
  EXPECT_LT(discrepancy_shifts(left(5.0, 1.65), columns, everywhere()).norm(),
            0.1 * discrepancy_shifts(left(5.0, 50.0), columns, everywhere()).norm());
}

// oracle: signals of that energy among the columns, their coefficients by the normal equations
TEST(LawDiscrepancy, IsTheMostThatAnySignalOfThatEnergyMovesACoefficient) {
  constexpr double excess = 3.0, z = 16.45;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Eigen::MatrixXd columns = normal_numbers(n, k, seed);
    columns.col(1) += 5.0 * columns.col(0);  // far from orthogonal
    columns.col(2) *= 1e-6;                  // in units of its own
    Eigen::VectorXd const shifts = discrepancy_shifts(left(excess, z), columns, everywhere());
    Eigen::MatrixXd const inverse = test::inverse(columns.transpose() * columns);
    double const length = std::sqrt(0.9 * excess);
    Eigen::MatrixXd const span = basis_of(columns);
    Eigen::MatrixXd signals = span * normal_numbers(k, 2000, seed + 100);
    signals.colwise().normalize();
    Eigen::MatrixXd const moved = inverse * columns.transpose() * signals * length;
    for (Eigen::Index i = 0; i < k; ++i) {
      EXPECT_NEAR(shifts[i], length * std::sqrt(inverse(i, i)), 1e-6 * shifts[i]);
      EXPECT_LE(moved.row(i).cwiseAbs().maxCoeff(), shifts[i] * (1.0 + 1e-9));
      EXPECT_GE(moved.row(i).cwiseAbs().maxCoeff(), 0.8 * shifts[i]);
    }
  }
}

TEST(LawDiscrepancy, MovesAShapeNoFurtherThanItsBounds) {
  Eigen::MatrixXd const columns = normal_numbers(n, k, 3);
  CoefficientBounds room = everywhere();
  Eigen::VectorXd const free = discrepancy_shifts(left(2.0, 40.0), columns, room);
  room.lower[3] = -0.5 * free[3];
  room.upper[3] = 0.25 * free[3];
  EXPECT_NEAR(discrepancy_shifts(left(2.0, 40.0), columns, room)[3], 0.5 * free[3], 1e-9 * free[3]);
}

// oracle: the largest coefficient among many points on the ellipsoid of that energy that lie within the bounds
TEST(LawDiscrepancy, KnowsWhatTheBoundsOfAnotherLeave) {
  constexpr double energy = 0.9 * 3.0;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, 2);
  columns(0, 0) = 1.0;
  columns(0, 1) = 0.99;  // nearly the same
  columns(1, 1) = std::sqrt(1.0 - 0.99 * 0.99);
  for (double const room_of_other : {0.0, 0.3, 2.0, 1e3}) {
    CoefficientBounds room{Eigen::Vector2d(-1e9, -room_of_other), Eigen::Vector2d(1e9, room_of_other)};
    double most = 0.0;
    Eigen::Matrix2d const inverse = Eigen::Matrix2d(columns.topRows(2)).inverse();
    for (int i = 0; i < 200000; ++i) {
      double const angle = 2e-5 * std::acos(-1.0) * 0.5 * i;
      Eigen::Vector2d const x = inverse * Eigen::Vector2d(std::cos(angle), std::sin(angle)) * std::sqrt(energy);
      if (std::abs(x[1]) <= room_of_other) most = std::max(most, std::abs(x[0]));
    }
    // without room for the other the points within are none but two
    if (room_of_other == 0.0) most = std::sqrt(energy);
    EXPECT_NEAR(discrepancy_shifts(left(3.0, 16.45), columns, room)[0], most, 2e-3 * most) << room_of_other;
  }
}

TEST(LawDiscrepancy, OfColumnsThatAreTheSameKnowsTheirSumOnly) {
  Eigen::MatrixXd columns = normal_numbers(n, k, 4);
  columns.col(1) = columns.col(0);
  Eigen::VectorXd const shifts = discrepancy_shifts(left(2.0, 40.0), columns, everywhere());
  EXPECT_TRUE(shifts.allFinite());
  EXPECT_GT(shifts[0], 0.0);
}

}  // namespace law_discrepancy_test
