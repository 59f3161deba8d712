#pragma once
// Decompositions of dense matrices as plain functions: Eigen's templates, compiled once for all layers.
//
// Why        each use of a decomposition in a file of its own costs seconds of a cold build
// Bits       vectors and matrices have functions of their own, because Eigen adds in another order for one column
// Threads    pure functions
// Source     Eigen 3.4, module documentation of Cholesky, QR, SVD and Eigenvalues

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <utility>

namespace torquescope {

// square = L L', of the lower triangle of square
class CholeskyFactor {
 public:
  explicit CholeskyFactor(Eigen::MatrixXd lower) : lower_(std::move(lower)) {}

  Eigen::MatrixXd const& lower() const { return lower_; }  // zero above the diagonal
  Eigen::VectorXd solve(Eigen::VectorXd right) const;      // square^-1 right
  Eigen::MatrixXd solve(Eigen::MatrixXd right) const;
  Eigen::MatrixXd solve_lower(Eigen::MatrixXd right) const;  // L^-1 right
  Eigen::MatrixXd solve_upper(Eigen::MatrixXd right) const;  // L'^-1 right

 private:
  Eigen::MatrixXd lower_;
};

// nothing where the matrix is not positive definite
std::optional<CholeskyFactor> cholesky_of(Eigen::MatrixXd const& square);

// square^-1 right of a positive definite matrix: numbers of no meaning where it is not
Eigen::VectorXd solve_positive(Eigen::MatrixXd const& square, Eigen::VectorXd const& right);
Eigen::MatrixXd solve_positive(Eigen::MatrixXd const& square, Eigen::MatrixXd const& right);
// the same by L D L' with pivoting, which positive semidefinite ones survive
Eigen::VectorXd solve_semidefinite(Eigen::MatrixXd const& square, Eigen::VectorXd const& right);
Eigen::MatrixXd solve_semidefinite(Eigen::MatrixXd const& square, Eigen::MatrixXd const& right);

// least squares; pivoted: dependent columns get 0, shortest: of all solutions the one of least norm
Eigen::VectorXd solve_pivoted(Eigen::MatrixXd const& columns, Eigen::VectorXd const& right);
Eigen::VectorXd solve_shortest(Eigen::MatrixXd const& columns, Eigen::VectorXd const& right);
Eigen::MatrixXd solve_shortest(Eigen::MatrixXd const& columns, Eigen::MatrixXd const& right);

// columns = Q R without pivoting, R of as many rows as Q has columns
struct QrFactors {
  Eigen::MatrixXd r;
  Eigen::MatrixXd q_right;  // Q' right
};
QrFactors qr_factors(Eigen::MatrixXd const& columns, Eigen::MatrixXd const& right);
Eigen::MatrixXd triangle_of(Eigen::MatrixXd const& columns);
// the same of many rows: a few hundred at a time, which stay in the cache, beside the triangle of those before
QrFactors qr_factors_by_rows(Eigen::MatrixXd const& columns, Eigen::VectorXd const& right);

// columns P = Q R with pivoting; what is below the threshold, of the largest pivot, is dependent
class PivotedQr {
 public:
  PivotedQr(Eigen::MatrixXd const& columns, double threshold);
  ~PivotedQr();
  PivotedQr(PivotedQr&&) noexcept;
  PivotedQr& operator=(PivotedQr&&) noexcept;

  Eigen::Index rank() const;
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const;  // least squares; dependent columns get 0
  Eigen::MatrixXd inverse_triangle() const;                   // of R's first rank rows and columns
  Eigen::VectorXi order() const;                              // which column is at each place of R
  Eigen::MatrixXd basis() const;                              // orthonormal, of the columns' span
  Eigen::MatrixXd projected(Eigen::MatrixXd signals, Eigen::Index dimensions) const;  // onto the first of Q

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};
// the same with Eigen's own threshold
Eigen::MatrixXd basis_of(Eigen::MatrixXd const& columns);

// square = vectors diag(values) vectors', smallest first, of the lower triangle
struct SymmetricAxes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricAxes symmetric_axes(Eigen::MatrixXd const& square);
Eigen::VectorXd symmetric_eigenvalues(Eigen::MatrixXd const& square);

// largest first
Eigen::VectorXd singular_values(Eigen::MatrixXd const& matrix);
struct RightSingular {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
RightSingular right_singular(Eigen::MatrixXd const& square);
Eigen::VectorXd singular_values_of_square(Eigen::MatrixXd const& square);

}  // namespace torquescope
