// The energy a group of columns explains is the minimum over all parameters of the right sign, found here another way:
// coordinate descent on nuisance and group together, which needs no projection and no enumeration.

#include "engine/fit/statistics/bounded_projection.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "support/decompositions.hpp"

namespace torquescope {
namespace bounded_projection_test {

constexpr double rounding = 1e-10;  // of numbers of size 1

Eigen::MatrixXd random_matrix(std::uint32_t set, std::uint32_t part, Eigen::Index rows, Eigen::Index cols) {
  RandomStream stream({31, set, RandomDomain::test}, 0, part);
  Eigen::MatrixXd made(rows, cols);
  for (double& value : made.reshaped()) value = stream.normal();
  return made;
}

struct Problem {
  Eigen::MatrixXd columns, nuisance_columns;
  Eigen::VectorXd y;
  std::vector<bool> non_negative;

  Eigen::MatrixXd nuisance() const { return orthonormal_basis(nuisance_columns); }
  OrthonormalGroup group() const { return orthonormal_group(columns, nuisance(), non_negative); }
  BoundedGain gain() const {
    auto const made = group();
    return bounded_gain(made, made.q.transpose() * y);
  }
};

// one to five columns, none to all of them signed, beside three of nuisance
Problem random_problem(std::uint32_t set) {
  constexpr Eigen::Index rows = 40;
  Eigen::Index const width = 1 + set % 5;
  RandomStream stream({32, set, RandomDomain::test}, 0, 0);
  Problem made{random_matrix(set, 0, rows, width), random_matrix(set, 1, rows, 3), random_matrix(set, 2, rows, 1), {}};
  // a common part makes bounds bind and unbind each other
  made.columns.colwise() += 0.7 * random_matrix(set, 3, rows, 1).col(0);
  made.columns += made.nuisance_columns * random_matrix(set, 4, 3, width);
  for (Eigen::Index k = 0; k < width; ++k) made.non_negative.push_back(stream.uniform() < 0.6);
  return made;
}

struct Descended {
  double left = 0.0;
  Eigen::VectorXd group;
};

// convex and strictly so for independent columns: one coordinate after the other reaches the only minimum
Descended descend(Problem const& problem, bool with_group) {
  Eigen::Index const k = problem.nuisance_columns.cols(), width = with_group ? problem.columns.cols() : 0;
  Eigen::MatrixXd all(problem.y.size(), k + width);
  all << problem.nuisance_columns, problem.columns.leftCols(width);
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(all.cols()), left = problem.y;
  for (int sweep = 0; sweep < 20000; ++sweep) {
    double largest = 0.0;
    for (Eigen::Index i = 0; i < all.cols(); ++i) {
      double next = theta[i] + all.col(i).dot(left) / all.col(i).squaredNorm();
      if (i >= k && problem.non_negative[static_cast<std::size_t>(i - k)]) next = std::max(0.0, next);
      largest = std::max(largest, std::abs(next - theta[i]));
      left -= (next - theta[i]) * all.col(i);
      theta[i] = next;
    }
    if (largest < 1e-14) break;
  }
  return {left.squaredNorm(), theta.tail(width)};
}

TEST(BoundedGain, IsTheLargestThatSignsAndNuisanceLeave) {
  int at_zero = 0;
  for (std::uint32_t set = 0; set < 200; ++set) {
    Problem const problem = random_problem(set);
    Descended const best = descend(problem, true);
    BoundedGain const found = problem.gain();
    EXPECT_NEAR(found.gain, descend(problem, false).left - best.left, 1e-8) << set;
    ASSERT_EQ(found.parameters.size(), problem.columns.cols());
    EXPECT_LT((found.parameters - best.group).cwiseAbs().maxCoeff(), 1e-7) << set;
    for (Eigen::Index k = 0; k < found.parameters.size(); ++k)
      if (problem.non_negative[static_cast<std::size_t>(k)]) {
        EXPECT_GE(found.parameters[k], 0.0) << set;
        at_zero += found.parameters[k] == 0.0;
      }
  }
  EXPECT_GT(at_zero, 50);  // else the bounds were never asked
}

TEST(BoundedGain, OfFreeParametersIsLeastSquares) {
  for (std::uint32_t set = 300; set < 320; ++set) {
    Problem problem = random_problem(set);
    problem.non_negative.assign(problem.non_negative.size(), false);
    Eigen::MatrixXd all(problem.y.size(), problem.nuisance_columns.cols() + problem.columns.cols());
    all << problem.nuisance_columns, problem.columns;
    Eigen::VectorXd const theta = test::least_squares(all, problem.y);
    EXPECT_LT((problem.gain().parameters - theta.tail(problem.columns.cols())).cwiseAbs().maxCoeff(), rounding) << set;
  }
}

TEST(BoundedGain, OfAColumnWithTheWrongSignIsNothing) {
  Problem problem = random_problem(0);
  ASSERT_EQ(problem.columns.cols(), 1);
  problem.y = -2.0 * problem.columns.col(0);
  problem.non_negative = {true};
  EXPECT_EQ(problem.gain().gain, 0.0);
  EXPECT_EQ(problem.gain().parameters[0], 0.0);
  problem.non_negative = {false};
  EXPECT_NEAR(problem.gain().parameters[0], -2.0, rounding);
}

TEST(OrthonormalGroup, IsOrthonormalAndSpansTheColumnsLessTheNuisance) {
  for (std::uint32_t set = 0; set < 50; ++set) {
    Problem const problem = random_problem(set);
    OrthonormalGroup const group = problem.group();
    Eigen::MatrixXd const nuisance = problem.nuisance();
    ASSERT_EQ(group.rank(), problem.columns.cols());
    Eigen::MatrixXd const unit = Eigen::MatrixXd::Identity(group.rank(), group.rank());
    EXPECT_LT((group.q.transpose() * group.q - unit).cwiseAbs().maxCoeff(), rounding);
    EXPECT_LT((nuisance.transpose() * group.q).cwiseAbs().maxCoeff(), rounding);
    Eigen::MatrixXd beside = problem.columns;
    for (auto column : beside.colwise()) column = test::left_beside(problem.nuisance_columns, column);
    EXPECT_LT((group.q * group.r - beside).cwiseAbs().maxCoeff(), rounding);
  }
}

TEST(OrthonormalGroup, KeepsItsDigitsForAColumnThatIsNearlyNuisance) {
  Problem problem = random_problem(2);
  // a hundred thousandth is its own: well above what is dropped
  problem.columns.col(0) = problem.nuisance_columns.col(0) + 1e-5 * problem.columns.col(0);
  OrthonormalGroup const group = problem.group();
  EXPECT_EQ(group.rank(), problem.columns.cols());
  EXPECT_LT((problem.nuisance().transpose() * group.q).cwiseAbs().maxCoeff(), rounding);
}

// two directions, their sum, one that is nuisance and one that is nothing
Problem deficient_problem(std::uint32_t set, bool is_signed) {
  constexpr Eigen::Index rows = 40;
  Eigen::MatrixXd const own = random_matrix(set, 10, rows, 2);
  Problem made{Eigen::MatrixXd(rows, 5), random_matrix(set, 11, rows, 3), random_matrix(set, 12, rows, 1), {}};
  made.columns << own, own.col(0) + own.col(1), made.nuisance_columns.col(1), Eigen::VectorXd::Zero(rows);
  made.non_negative.assign(5, is_signed);
  return made;
}

Problem first_columns(Problem problem, Eigen::Index count) {
  problem.columns = problem.columns.leftCols(count).eval();
  problem.non_negative.resize(static_cast<std::size_t>(count));
  return problem;
}

TEST(OrthonormalGroup, DropsWhatIsNoDirectionOfItsOwn) {
  for (std::uint32_t set = 0; set < 20; ++set) {
    Problem const problem = deficient_problem(set, false);
    EXPECT_EQ(problem.group().rank(), 2);
    EXPECT_NEAR(problem.gain().gain, first_columns(problem, 2).gain().gain, 1e-9) << set;
  }
}

TEST(BoundedGain, OfDependentColumnsIsThatOfWhatTheyAddUpTo) {
  for (std::uint32_t set = 0; set < 20; ++set) {
    Problem const problem = first_columns(deficient_problem(set, true), 3);
    BoundedGain const found = problem.gain();
    Descended const best = descend(problem, true);
    EXPECT_NEAR(found.gain, descend(problem, false).left - best.left, 1e-8) << set;
    EXPECT_GE(found.parameters.minCoeff(), 0.0);
    // parameters are not unique, their torque is
    OrthonormalGroup const group = problem.group();
    EXPECT_LT((group.r * (found.parameters - best.group)).cwiseAbs().maxCoeff(), 1e-6) << set;
  }
}

// r keeps the rounding (1e-16) of a column that was dropped; alone in a subset it must not pass for a direction
TEST(BoundedGain, OfASignedColumnThatIsNuisanceIsNothing) {
  for (std::uint32_t set = 0; set < 20; ++set) {
    Problem const problem = deficient_problem(set, true);
    Problem const three = first_columns(problem, 3);
    BoundedGain const found = problem.gain();
    EXPECT_NEAR(found.gain, descend(three, false).left - descend(three, true).left, 1e-8) << set;
    EXPECT_LT(found.parameters.maxCoeff(), 100.0) << set;
  }
}

TEST(OrthonormalGroup, OfColumnsThatAreAllNuisanceExplainsNothing) {
  Problem problem = random_problem(1);
  problem.columns = problem.nuisance_columns * random_matrix(1, 20, 3, 2);
  problem.non_negative = {true, false};
  EXPECT_EQ(problem.group().rank(), 0);
  EXPECT_EQ(problem.gain().gain, 0.0);
  EXPECT_EQ(problem.gain().parameters, Eigen::VectorXd(Eigen::VectorXd::Zero(2)));
}

TEST(OrthonormalBasis, HasOneColumnPerDirectionWhateverTheirLengths) {
  Eigen::MatrixXd columns = random_matrix(5, 0, 30, 4);
  columns.col(1) *= 1e-12;
  columns.col(2) = columns.col(0) - 3.0 * columns.col(3);
  Eigen::MatrixXd const basis = orthonormal_basis(columns);
  ASSERT_EQ(basis.cols(), 3);
  EXPECT_LT((basis.transpose() * basis - Eigen::MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff(), rounding);
  Eigen::MatrixXd const outside = columns - basis * (basis.transpose() * columns);
  for (Eigen::Index k = 0; k < 4; ++k) EXPECT_LT(outside.col(k).norm() / columns.col(k).norm(), rounding) << k;
}

}  // namespace bounded_projection_test
}  // namespace torquescope
