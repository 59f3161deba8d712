#include "support/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace torquescope::test {

Eigen::VectorXd least_squares(Eigen::MatrixXd const& columns, Eigen::VectorXd const& y) {
  return columns.colPivHouseholderQr().solve(y);
}

Eigen::VectorXd left_beside(Eigen::MatrixXd const& columns, Eigen::VectorXd const& y) {
  return y - columns * least_squares(columns, y);
}

Eigen::VectorXd eigenvalues(Eigen::MatrixXd const& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXd singular_values(Eigen::MatrixXd const& matrix) {
  return Eigen::BDCSVD<Eigen::MatrixXd>(matrix).singularValues();
}

}  // namespace torquescope::test
