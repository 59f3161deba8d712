#pragma once
// An arm once more on the references of a recording, in the recording's loops, without noise and without encoders.
//
// Tick       one a sample: each joint's controller sees its true position, and holds its torque until the next tick
// Start      at the recording's first positions and velocities
// Shapes     n samples, N joints
// Units      SI
// Error      nothing is returned where the arm runs away: its loop is unstable, or it has no mass somewhere
// Threads    free function
// Source     Janot, Vandanjon, Gautier 2014, doi:10.1109/TCST.2013.2246163 (what the replicate is for)

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/simulate/arm_plant.hpp"
#include "engine/simulate/loop_controller.hpp"

namespace torquescope {

// of one joint
struct ArmJointLoop {
  LoopController controller{};
  Eigen::VectorXd reference{};    // [n]
  Eigen::VectorXd fed_forward{};  // [n] beside the controller, or empty
  double start_position = 0.0, start_velocity = 0.0;
  double farthest = 0.0;  // from the reference: beyond, the arm has run away
};

// positions, n x N
std::optional<Eigen::MatrixXd> replicate_arm(ArmPlant plant, std::vector<ArmJointLoop> const& loops, double rate_hz,
                                             double step_s);

}  // namespace torquescope
