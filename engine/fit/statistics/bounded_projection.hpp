#pragma once
// Linear parameters solved inside: how much of a signal a group of columns explains, with the signs physics allows.
//
// Equation   max over theta of ||y||^2 - ||y - C theta||^2, theta_i >= 0 where the parameter has that sign;
//            C is made orthogonal to the nuisance columns first (Frisch, Waugh), C = Q R
// Method     every subset of the signed parameters is tried at zero: exact, and groups have at most 8 columns
// Shapes     R: L x L upper triangular (columns permuted), c = Q' y: L
// Threads    plain records, free functions
// Source     Golub, Pereyra 1973 (variable projection); Lawson, Hanson 1974 (signs)

#include <Eigen/Core>
#include <vector>

#include "engine/fit/statistics/equal_blocks.hpp"

namespace torquescope {

// an orthonormal basis of a group of columns, without what other columns explain already
struct OrthonormalGroup {
  Eigen::MatrixXd q;                 // n x rank
  Eigen::MatrixXd r;                 // rank x L: columns (less the nuisance) = q r
  std::vector<bool> non_negative{};  // L

  Eigen::Index rank() const { return q.cols(); }
};

// columns: n x L; nuisance: n x k, orthonormal. Directions that keep less than a millionth of a column are dropped
OrthonormalGroup orthonormal_group(Eigen::MatrixXd columns, Eigen::MatrixXd const& nuisance,
                                   std::vector<bool> const& non_negative);
// several groups of L columns, side by side: the nuisance is read once for all of them
std::vector<OrthonormalGroup> orthonormal_groups(Eigen::MatrixXd columns, Eigen::MatrixXd const& nuisance,
                                                 std::vector<bool> const& non_negative);

// A' B, and over some rows alone
Eigen::MatrixXd inner_products(Eigen::Ref<Eigen::MatrixXd const> const& a, Eigen::Ref<Eigen::MatrixXd const> const& b);
Eigen::MatrixXd inner_products(Eigen::Ref<Eigen::MatrixXd const> const& a, Eigen::Ref<Eigen::MatrixXd const> const& b,
                               RowBlock const& rows);

struct BoundedGain {
  double gain = 0.0;           // energy
  Eigen::VectorXd parameters;  // L
};

// c = q' y
BoundedGain bounded_gain(OrthonormalGroup const& group, Eigen::VectorXd const& c);

// an orthonormal basis of all columns, dependent ones dropped
Eigen::MatrixXd orthonormal_basis(Eigen::MatrixXd const& columns);

}  // namespace torquescope
