// The statistic of an effect against fits made anew without each fold and its guard, by brute force.

#include "engine/infer/decision/score.hpp"

#include <gtest/gtest.h>

#include <random>

#include "engine/simulate/rollout/effective_samples.hpp"

using namespace torquescope;

namespace score_test {

constexpr Eigen::Index rows = 330, guard = 6;

struct Problem {
  Eigen::MatrixXd base, effect, signals;
};

// the first signal has the effect, the second its negative, the third none of it
Problem problem() {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  auto const any = [&](Eigen::Index n, Eigen::Index k) {
    Eigen::MatrixXd m(n, k);
    for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = normal(random);
    return m;
  };
  Problem made{any(rows, 3), any(rows, 1), any(rows, 3)};
  // each row is like the one before it: independent squares are fewer than rows
  for (Eigen::Index i = 1; i < rows; ++i) made.signals.row(i) += 0.7 * made.signals.row(i - 1);
  made.effect += 0.5 * made.base.col(1);
  made.signals += made.base * any(3, 3);
  made.signals.col(0) += 0.8 * made.effect;
  made.signals.col(1) -= 0.8 * made.effect;
  return made;
}

// an orthonormal basis of these columns by Householder's reflections
Eigen::MatrixXd basis_of(Eigen::MatrixXd const& columns) {
  Eigen::HouseholderQR<Eigen::MatrixXd> const qr(columns);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

// residuals on the rows of each fold by a fit to the rows that are neither in it nor in its guard
Eigen::MatrixXd validation_residuals(Eigen::MatrixXd const& columns, Eigen::MatrixXd const& signals, FoldKind kind) {
  Eigen::MatrixXd const basis = basis_of(columns);
  Eigen::MatrixXd residuals = Eigen::MatrixXd::Constant(signals.rows(), signals.cols(), 1e9);
  for (auto const& fold : folds(signals.rows(), guard, kind)) {
    Eigen::VectorXd seen = Eigen::VectorXd::Ones(signals.rows());
    for (auto const& blocks : {fold.inside, fold.guard})
      for (auto const& block : blocks) seen.segment(block.from, block.to - block.from).setZero();
    Eigen::MatrixXd gram = basis.transpose() * seen.asDiagonal() * basis;
    gram.diagonal().array() += left_out_ridge;
    Eigen::MatrixXd const fit = gram.ldlt().solve(basis.transpose() * seen.asDiagonal() * signals);
    for (auto const& block : fold.inside)
      residuals.middleRows(block.from, block.to - block.from) =
          (signals - basis * fit).middleRows(block.from, block.to - block.from);
  }
  return residuals;
}

Eigen::MatrixXd side_by_side(Eigen::MatrixXd const& left, Eigen::MatrixXd const& right) {
  Eigen::MatrixXd both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

void expect_near(Eigen::VectorXd const& found, Eigen::VectorXd const& wanted) {
  EXPECT_LT((found - wanted).cwiseAbs().maxCoeff(), 1e-9 * wanted.cwiseAbs().maxCoeff());
}

TEST(Score, LeavesWhatFitsWithoutEachFoldLeave) {
  Problem const of = problem();
  for (auto const kind : {FoldKind::whole, FoldKind::interleaved}) {
    Score const score(of.base, of.signals, guard, kind);
    auto const group = orthonormal_group(of.effect, score.basis(), {false});
    Eigen::MatrixXd const before = validation_residuals(of.base, of.signals, kind);
    Eigen::MatrixXd const after = validation_residuals(side_by_side(of.base, of.effect), of.signals, kind);
    expect_near(score.left(), before.colwise().squaredNorm().transpose());
    expect_near(score.left_with(group), after.colwise().squaredNorm().transpose());
    for (Eigen::Index k = 0; k < 3; ++k) {
      expect_near(score.left_on_rows_with({}, k), before.col(k));
      expect_near(score.left_on_rows_with(group, k), after.col(k));
    }
  }
}

TEST(Score, GainIsTheFallOfTheLogarithmTimesIndependentSquares) {
  Problem const of = problem();
  for (auto const kind : {FoldKind::whole, FoldKind::interleaved}) {
    Score const score(of.base, of.signals, guard, kind);
    auto const group = orthonormal_group(of.effect, score.basis(), {false});
    for (Eigen::Index k = 0; k < 2; ++k) {
      Eigen::VectorXd const before = validation_residuals(of.base, of.signals, kind).col(k);
      Eigen::VectorXd const after = validation_residuals(side_by_side(of.base, of.effect), of.signals, kind).col(k);
      double const squares = effective_samples(after);
      EXPECT_LT(squares, 0.8 * static_cast<double>(rows));
      double const wanted = squares * std::log(before.squaredNorm() / after.squaredNorm());
      EXPECT_GT(wanted, 20.0);
      EXPECT_NEAR(score.gain(group, k), wanted, 1e-8 * wanted);
    }
  }
}

TEST(Score, AWrongSignGainsNothing) {
  Problem const of = problem();
  Score const score(of.base, of.signals, guard);
  auto const group = orthonormal_group(of.effect, score.basis(), {true});
  EXPECT_GT(score.gain(group, 0), 20.0);
  EXPECT_EQ(score.gain(group, 1), 0.0);
  Eigen::VectorXd const left = score.left(), with = score.left_with(group);
  EXPECT_LT(with[0], 0.9 * left[0]);
  EXPECT_EQ(with[1], left[1]);
}

TEST(Score, AnEffectOfTheModelGainsNothing) {
  Problem const of = problem();
  Score const score(of.base, of.signals, guard);
  auto const group = orthonormal_group(of.base.col(2), score.basis(), {false});
  EXPECT_EQ(score.gain(group, 0), 0.0);
  EXPECT_EQ(score.left_with(group), score.left());
}

}  // namespace score_test
