#pragma once
// An arm in MuJoCo: a model made from a chain, or read by MuJoCo itself from a URDF. Only where MuJoCo is installed.

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

#include "engine/robot/serial_chain.hpp"

namespace torquescope::test {

class MujocoModel {
 public:
  // masses, inertias and attitudes are written into the loaded model: its reader rounds them
  explicit MujocoModel(SerialChain const& chain);
  // as MuJoCo reads it, URDF or MJCF
  static MujocoModel of_xml(std::string const& xml);

  Eigen::VectorXd inverse_dynamics(Eigen::VectorXd const& q, Eigen::VectorXd const& dq, Eigen::VectorXd const& ddq);
  Eigen::VectorXd forward_dynamics(Eigen::VectorXd const& q, Eigen::VectorXd const& dq, Eigen::VectorXd const& tau);

 private:
  explicit MujocoModel(std::string const& xml);
  void set_state(Eigen::VectorXd const& q, Eigen::VectorXd const& dq);

  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
};

}  // namespace torquescope::test
