#include "support/decompositions.hpp"

#include "engine/base/dense_solvers.hpp"

namespace torquescope::test {

Eigen::VectorXd least_squares(Eigen::MatrixXd const& columns, Eigen::VectorXd const& y) {
  return solve_pivoted(columns, y);
}

Eigen::VectorXd left_beside(Eigen::MatrixXd const& columns, Eigen::VectorXd const& y) {
  return y - columns * least_squares(columns, y);
}

Eigen::MatrixXd inverse(Eigen::MatrixXd const& positive) {
  return solve_positive(positive, Eigen::MatrixXd(Eigen::MatrixXd::Identity(positive.rows(), positive.cols())));
}

Eigen::MatrixXd information_root(Eigen::MatrixXd const& covariance) {
  return cholesky_of(covariance)->solve_lower(Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols()));
}

Eigen::VectorXd eigenvalues(Eigen::MatrixXd const& symmetric) { return symmetric_eigenvalues(symmetric); }

Eigen::VectorXd singular_values(Eigen::MatrixXd const& matrix) { return torquescope::singular_values(matrix); }

}  // namespace torquescope::test
