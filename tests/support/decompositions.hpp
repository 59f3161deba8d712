#pragma once
// Eigen's decompositions as tests use them to check the engine: those of engine/base/dense_solvers.hpp, whose own
// effects are in tests/unit/base/dense_solvers.cpp. Each file that names one of Eigen's itself takes four seconds
// longer.

#include <Eigen/Core>

namespace torquescope::test {

// theta with the least ||y - columns * theta||, by QR with pivots
Eigen::VectorXd least_squares(Eigen::MatrixXd const& columns, Eigen::VectorXd const& y);

// what such a fit leaves of y
Eigen::VectorXd left_beside(Eigen::MatrixXd const& columns, Eigen::VectorXd const& y);

// of a positive definite matrix
Eigen::MatrixXd inverse(Eigen::MatrixXd const& positive);

// R of a positive definite covariance: R' R is its inverse
Eigen::MatrixXd information_root(Eigen::MatrixXd const& covariance);

// of a symmetric matrix, ascending
Eigen::VectorXd eigenvalues(Eigen::MatrixXd const& symmetric);

// descending
Eigen::VectorXd singular_values(Eigen::MatrixXd const& matrix);

}  // namespace torquescope::test
