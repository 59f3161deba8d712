#include "engine/infer/pipeline/motion_axes.hpp"

#include <cmath>

namespace torquescope {
namespace {

Eigen::VectorXd distance_since(Eigen::VectorXd const& signal, Eigen::VectorXd const& q) {
  Eigen::VectorXd distance = Eigen::VectorXd::Zero(q.size());
  for (Eigen::Index k = 1; k < q.size(); ++k)
    distance[k] = signal[k] * signal[k - 1] < 0.0 ? 0.0 : distance[k - 1] + std::abs(q[k] - q[k - 1]);
  return distance;
}

}  // namespace

MotionAxes motion_axes(JointModel const& model, ProcessedRecord const& record, Eigen::VectorXd const& parameters) {
  Motion const& motion = record.motion;
  Eigen::MatrixXd const columns = model.columns(motion, record.drive);
  MotionAxes axes{motion.time_s, motion.q, motion.dq, motion.ddq, {}, columns * parameters, {}, {}};
  axes.load_torque = Eigen::VectorXd::Zero(columns.rows());
  auto const& owners = model.regressor().column_owners();
  for (std::size_t k = 0; k < owners.size(); ++k) {
    auto const at = static_cast<Eigen::Index>(k);
    if (owners[k].needs_position || owners[k].needs_acceleration) axes.load_torque += columns.col(at) * parameters[at];
  }
  if (auto const& beside = model.reference().gear_load) {
    axes.load_torque += *beside;
    axes.model_torque += *beside;
  }
  axes.since_velocity_reversal = distance_since(motion.dq, motion.q);
  axes.since_torque_reversal = distance_since(axes.model_torque, motion.q);
  return axes;
}

}  // namespace torquescope
