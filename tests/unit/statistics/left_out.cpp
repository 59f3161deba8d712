// Fits without a fold, in closed form: against least squares made anew without those rows.

#include "engine/fit/statistics/left_out.hpp"

#include <gtest/gtest.h>

#include <random>

#include "engine/base/dense_solvers.hpp"
#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/fit/statistics/left_out_gains.hpp"

using namespace torquescope;

namespace left_out_test {

struct Problem {
  Eigen::MatrixXd columns, signals, basis;
};

Problem problem(Eigen::Index rows) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  auto const any = [&](Eigen::Index n, Eigen::Index k) {
    Eigen::MatrixXd m(n, k);
    for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = normal(random);
    return m;
  };
  Problem made{any(rows, 4), any(rows, 3), {}};
  made.basis = orthonormal_basis(made.columns);
  return made;
}

std::vector<Eigen::Index> rows_of(std::vector<RowBlock> const& blocks) {
  std::vector<Eigen::Index> rows;
  for (auto const& block : blocks)
    for (Eigen::Index i = block.from; i < block.to; ++i) rows.push_back(i);
  return rows;
}

// energies inside each fold by fits to the other rows
Eigen::MatrixXd made_anew(std::vector<Fold> const& folds, Problem const& of) {
  Eigen::MatrixXd left(static_cast<Eigen::Index>(folds.size()), of.signals.cols());
  for (std::size_t f = 0; f < folds.size(); ++f) {
    std::vector<bool> is_seen(static_cast<std::size_t>(of.columns.rows()), true);
    auto const inside = rows_of(folds[f].inside);
    for (auto const& blocks : {folds[f].inside, folds[f].guard})
      for (auto const row : rows_of(blocks)) is_seen[static_cast<std::size_t>(row)] = false;
    std::vector<Eigen::Index> seen;
    for (Eigen::Index i = 0; i < of.columns.rows(); ++i)
      if (is_seen[static_cast<std::size_t>(i)]) seen.push_back(i);
    Eigen::MatrixXd const fit =
        solve_shortest(of.columns(seen, Eigen::all), Eigen::MatrixXd(of.signals(seen, Eigen::all)));
    left.row(static_cast<Eigen::Index>(f)) =
        (of.signals(inside, Eigen::all) - of.columns(inside, Eigen::all) * fit).colwise().squaredNorm();
  }
  return left;
}

TEST(LeftOut, IsWhatFitsToTheOtherRowsLeave) {
  Problem const of = problem(400);
  for (auto const kind : {FoldKind::whole, FoldKind::interleaved}) {
    auto const parts = folds(400, 7, kind);
    ASSERT_EQ(parts.size(), 10U);
    FoldProducts const gram = fold_products(parts, of.basis, of.basis);
    FoldProducts const products = fold_products(parts, of.basis, of.signals);
    Eigen::MatrixXd const left = fold_energies(parts, of.signals) + left_inside_less_own(gram, products);
    Eigen::MatrixXd const wanted = made_anew(parts, of);
    // the ridge shrinks a fit by a ten-thousandth
    EXPECT_LT((left - wanted).cwiseAbs().maxCoeff(), 1e-3 * wanted.maxCoeff());
    Eigen::VectorXd const on_rows =
        left_on_rows(parts, of.basis, of.signals.col(0), gram, picked(products, 0, products.whole.rows(), 0, 1));
    EXPECT_NEAR(on_rows.squaredNorm(), left.col(0).sum(), 1e-9 * left.col(0).sum());
  }
}

TEST(LeftOut, EveryRowIsPredictedOnce) {
  for (auto const kind : {FoldKind::whole, FoldKind::interleaved}) {
    std::vector<int> times(397, 0);
    for (auto const& fold : folds(397, 11, kind))
      for (auto const row : rows_of(fold.inside)) ++times[static_cast<std::size_t>(row)];
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), 397);
  }
}

// two bases side by side, from their parts
TEST(LeftOut, ProductsOfTwoBasesAreThoseOfBothTogether) {
  Problem const of = problem(200);
  auto const parts = folds(200, 3, FoldKind::whole);
  Eigen::MatrixXd const first = of.basis.leftCols(3), second = of.basis.rightCols(1);
  FoldProducts const gram = gram_of(fold_products(parts, first, first), fold_products(parts, second, first),
                                    fold_products(parts, second, second));
  FoldProducts const whole = fold_products(parts, of.basis, of.basis);
  for (std::size_t f = 0; f < parts.size(); ++f)
    EXPECT_LT((gram.left_out[f] - whole.left_out[f]).cwiseAbs().maxCoeff(), 1e-13);
}

// what a candidate takes beside a basis is what both leave less than the basis alone
TEST(LeftOut, GainsBesideABasisAreTheDifferenceOfTwoFits) {
  Problem const of = problem(400);
  for (auto const kind : {FoldKind::whole, FoldKind::interleaved}) {
    auto const parts = folds(400, 7, kind);
    for (Eigen::Index width : {0, 1, 2}) {
      Eigen::MatrixXd const first = of.basis.leftCols(4 - width), second = of.basis.rightCols(width);
      FoldProducts const gram = fold_products(parts, first, first), products = fold_products(parts, first, of.signals);
      Eigen::MatrixXd const found = LeftOutGains(gram, products)
                                        .of(fold_products(parts, second, first), fold_products(parts, second, second),
                                            fold_products(parts, second, of.signals));
      Eigen::MatrixXd const wanted =
          left_inside_less_own(gram, products) -
          left_inside_less_own(fold_products(parts, of.basis, of.basis), fold_products(parts, of.basis, of.signals));
      EXPECT_LT((found - wanted).cwiseAbs().maxCoeff(), 1e-12 * of.signals.squaredNorm());
      EXPECT_EQ(wanted.cwiseAbs().maxCoeff() > 1e-6 * of.signals.squaredNorm(), width > 0);
    }
  }
}

// a direction that only the left-out rows hold predicts nothing
TEST(LeftOut, WhatNoOtherRowHoldsIsPredictedAsNothing) {
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(100, 1);
  basis.middleRows(20, 10).setConstant(1.0 / std::sqrt(10.0));
  Eigen::MatrixXd const signal = 3.0 * basis;
  auto const parts = folds(100, 0, FoldKind::whole);
  Eigen::MatrixXd const change =
      left_inside_less_own(fold_products(parts, basis, basis), fold_products(parts, basis, signal));
  EXPECT_NEAR(change.cwiseAbs().maxCoeff(), 0.0, 1e-12);
}

}  // namespace left_out_test
