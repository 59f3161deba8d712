#include "engine/base/dense_solvers.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// solve() of Eigen::LLT, step by step
template <typename Right>
Right solved(MatrixXd const& lower, Right right) {
  lower.triangularView<Eigen::Lower>().solveInPlace(right);
  lower.adjoint().triangularView<Eigen::Upper>().solveInPlace(right);
  return right;
}

}  // namespace

VectorXd CholeskyFactor::solve(VectorXd right) const { return solved(lower_, std::move(right)); }
MatrixXd CholeskyFactor::solve(MatrixXd right) const { return solved(lower_, std::move(right)); }

MatrixXd CholeskyFactor::solve_lower(MatrixXd right) const {
  lower_.triangularView<Eigen::Lower>().solveInPlace(right);
  return right;
}

MatrixXd CholeskyFactor::solve_upper(MatrixXd right) const {
  lower_.adjoint().triangularView<Eigen::Upper>().solveInPlace(right);
  return right;
}

std::optional<CholeskyFactor> cholesky_of(MatrixXd const& square) {
  Eigen::LLT<MatrixXd> const factor(square);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return CholeskyFactor(factor.matrixL());
}

VectorXd solve_positive(MatrixXd const& square, VectorXd const& right) {
  return Eigen::LLT<MatrixXd>(square).solve(right);
}
MatrixXd solve_positive(MatrixXd const& square, MatrixXd const& right) {
  return Eigen::LLT<MatrixXd>(square).solve(right);
}

VectorXd solve_semidefinite(MatrixXd const& square, VectorXd const& right) {
  return Eigen::LDLT<MatrixXd>(square).solve(right);
}
MatrixXd solve_semidefinite(MatrixXd const& square, MatrixXd const& right) {
  return Eigen::LDLT<MatrixXd>(square).solve(right);
}

VectorXd solve_pivoted(MatrixXd const& columns, VectorXd const& right) {
  return Eigen::ColPivHouseholderQR<MatrixXd>(columns).solve(right);
}

VectorXd solve_shortest(MatrixXd const& columns, VectorXd const& right) {
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(columns).solve(right);
}
MatrixXd solve_shortest(MatrixXd const& columns, MatrixXd const& right) {
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(columns).solve(right);
}

QrFactors qr_factors(MatrixXd const& columns, MatrixXd const& right) {
  Eigen::HouseholderQR<MatrixXd> const qr(columns);
  Index const k = std::min(columns.rows(), columns.cols());
  QrFactors factors{qr.matrixQR().topRows(k).triangularView<Eigen::Upper>(), MatrixXd(k, right.cols())};
  for (Index i = 0; i < right.cols(); ++i)  // one by one: each has the bits that it has alone
    factors.q_right.col(i) = VectorXd(qr.householderQ().adjoint() * right.col(i)).head(k);
  return factors;
}

MatrixXd triangle_of(MatrixXd const& columns) {
  Eigen::HouseholderQR<MatrixXd> const qr(columns);
  return qr.matrixQR().topRows(std::min(columns.rows(), columns.cols())).triangularView<Eigen::Upper>();
}

QrFactors qr_factors_by_rows(MatrixXd const& columns, VectorXd const& right) {
  constexpr Index at_once = 512;
  Index const width = columns.cols();
  // right is one more column: its part of the triangle is Q' right
  MatrixXd triangle(0, width + 1);
  for (Index first = 0; first < columns.rows(); first += at_once) {
    Index const count = std::min(at_once, columns.rows() - first), above = triangle.rows();
    MatrixXd stack(above + count, width + 1);
    stack.topRows(above) = triangle;
    stack.bottomLeftCorner(count, width) = columns.middleRows(first, count);
    stack.bottomRightCorner(count, 1) = right.segment(first, count);
    triangle = triangle_of(stack);
  }
  Index const k = std::min(triangle.rows(), width);
  return {triangle.topLeftCorner(k, width), triangle.col(width).head(k)};
}

struct PivotedQr::Factors {
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
};

PivotedQr::PivotedQr(MatrixXd const& columns, double threshold) : factors_(std::make_unique<Factors>()) {
  factors_->qr.setThreshold(threshold);
  factors_->qr.compute(columns);
}
PivotedQr::~PivotedQr() = default;
PivotedQr::PivotedQr(PivotedQr&&) noexcept = default;
PivotedQr& PivotedQr::operator=(PivotedQr&&) noexcept = default;

Index PivotedQr::rank() const { return factors_->qr.rank(); }

VectorXd PivotedQr::solve(VectorXd const& right) const { return factors_->qr.solve(right); }

MatrixXd PivotedQr::inverse_triangle() const {
  Index const n = rank();
  MatrixXd inverse = MatrixXd::Identity(n, n);
  factors_->qr.matrixR().topLeftCorner(n, n).triangularView<Eigen::Upper>().solveInPlace(inverse);
  return inverse;
}

Eigen::VectorXi PivotedQr::order() const { return factors_->qr.colsPermutation().indices(); }

MatrixXd PivotedQr::basis() const {
  return factors_->qr.householderQ() * MatrixXd::Identity(factors_->qr.rows(), rank());
}

MatrixXd PivotedQr::projected(MatrixXd signals, Index dimensions) const {
  signals.applyOnTheLeft(factors_->qr.householderQ().adjoint());
  signals.bottomRows(signals.rows() - dimensions).setZero();
  signals.applyOnTheLeft(factors_->qr.householderQ());
  return signals;
}

MatrixXd basis_of(MatrixXd const& columns) {
  Eigen::ColPivHouseholderQR<MatrixXd> const qr(columns);
  MatrixXd basis = MatrixXd::Identity(columns.rows(), qr.rank());
  basis.applyOnTheLeft(qr.householderQ());
  return basis;
}

SymmetricAxes symmetric_axes(MatrixXd const& square) {
  Eigen::SelfAdjointEigenSolver<MatrixXd> const axes(square);
  return {axes.eigenvalues(), axes.eigenvectors()};
}

VectorXd symmetric_eigenvalues(MatrixXd const& square) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(square, Eigen::EigenvaluesOnly).eigenvalues();
}

VectorXd singular_values(MatrixXd const& matrix) { return Eigen::JacobiSVD<MatrixXd>(matrix).singularValues(); }

// needs no QR before it
using SquareSvd = Eigen::JacobiSVD<MatrixXd, Eigen::NoQRPreconditioner>;

RightSingular right_singular(MatrixXd const& square) {
  SquareSvd const svd(square, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

VectorXd singular_values_of_square(MatrixXd const& square) { return SquareSvd(square).singularValues(); }

}  // namespace torquescope
