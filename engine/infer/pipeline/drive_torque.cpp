#include "engine/infer/pipeline/drive_torque.hpp"

#include "engine/infer/pipeline/held_torque.hpp"

namespace torquescope {

Eigen::VectorXd torque_taken_out(Recording const& recording) {
  if (recording.gear_load.size() == 0) return Eigen::VectorXd::Zero(recording.torque.size());
  return torque_to_hold(recording.gear_load);
}

Eigen::VectorXd drive_torque(Recording const& recording) { return recording.torque + torque_taken_out(recording); }

}  // namespace torquescope
