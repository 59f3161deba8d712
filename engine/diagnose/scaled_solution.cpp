#include "engine/diagnose/scaled_solution.hpp"

#include <Eigen/QR>

#include "engine/base/contract.hpp"

namespace torquescope {

Eigen::MatrixXd solve_scaled(Eigen::MatrixXd columns, Eigen::Ref<Eigen::MatrixXd const> const& signals) {
  TORQUESCOPE_EXPECT(columns.rows() == signals.rows());
  Eigen::VectorXd const per_length =
      columns.colwise().norm().unaryExpr([](double one) { return one > 0.0 ? 1.0 / one : 1.0; });
  columns *= per_length.asDiagonal();
  return per_length.asDiagonal() * Eigen::MatrixXd(columns.completeOrthogonalDecomposition().solve(signals));
}

Eigen::VectorXd beside_columns(Eigen::MatrixXd const& columns, Eigen::VectorXd const& signal) {
  return signal - columns * solve_scaled(columns, signal);
}

}  // namespace torquescope
