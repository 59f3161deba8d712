#include "engine/search/law_discrepancy.hpp"

#include <Eigen/QR>
#include <cmath>

namespace torquescope {

double sure_excess(MismatchEnergy const& left) {
  constexpr double one_sided = 1.645;
  return left.excess > 0.0 && left.z > one_sided ? left.excess * (1.0 - one_sided / left.z) : 0.0;
}

Eigen::VectorXd discrepancy_shifts(MismatchEnergy const& left, Eigen::MatrixXd const& columns,
                                   CoefficientBounds const& room) {
  Eigen::Index const k = columns.cols();
  double const energy = sure_excess(left);
  if (!(energy > 0.0)) return Eigen::VectorXd::Zero(k);
  // rows of the pseudo-inverse, in coordinates of the columns' span: each is the direction that moves its coefficient most
  Eigen::HouseholderQR<Eigen::MatrixXd> const qr(columns);
  Eigen::MatrixXd const r = qr.matrixQR().topRows(k).triangularView<Eigen::Upper>();
  Eigen::MatrixXd directions = solve_scaled(r, Eigen::MatrixXd::Identity(k, k)).transpose();
  for (Eigen::Index i = 0; i < k; ++i)
    if (double const length = directions.col(i).norm(); length > 0.0) directions.col(i) *= std::sqrt(energy) / length;
  Eigen::MatrixXd both(k, 2 * k);
  both << directions, -directions;
  Eigen::MatrixXd const steps = solve_scaled(r, both, room);
  return steps.leftCols(k).diagonal().cwiseAbs().cwiseMax(steps.rightCols(k).diagonal().cwiseAbs());
}

}  // namespace torquescope
