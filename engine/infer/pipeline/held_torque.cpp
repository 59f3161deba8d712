#include "engine/infer/pipeline/held_torque.hpp"

namespace torquescope {
namespace {

// from row `first` on: four rows in a row, the two in the middle weighed by `inner`, those beside them by `outer`
Eigen::VectorXd four_rows(Eigen::Ref<Eigen::VectorXd const> const& torque, Eigen::Index first, double inner,
                          double outer) {
  Eigen::VectorXd result = torque;
  Eigen::Index const n = torque.size() - 3;
  if (n <= 0) return result;
  auto const rows = [&](Eigen::Index from) { return torque.segment(from, n); };
  result.segment(first, n) = inner * (rows(1) + rows(2)) + outer * (rows(0) + rows(3));
  return result;
}

}  // namespace

Eigen::VectorXd acting_torque(Eigen::Ref<Eigen::VectorXd const> const& held) {
  return four_rows(held, 2, 13.0 / 24.0, -1.0 / 24.0);
}

Eigen::VectorXd torque_to_hold(Eigen::Ref<Eigen::VectorXd const> const& acting) {
  return four_rows(acting, 1, 7.0 / 12.0, -1.0 / 12.0);
}

}  // namespace torquescope
