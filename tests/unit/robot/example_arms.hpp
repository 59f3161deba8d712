#pragma once
// Arms for tests: known ones without inertias, and random ones with consistent inertias.

#include <Eigen/Core>
#include <cstdint>

#include "engine/robot/serial_chain.hpp"

namespace torquescope::test {

SerialChain crs_a465(std::size_t n_joints);
SerialChain ur10e();
SerialChain panda();
SerialChain puma_560();

struct RandomArm {
  SerialChain chain;  // with links and drive inertias
  Eigen::VectorXd q, dq, ddq;
};

// 1 to 7 joints. `special`: right and zero angles, zero lengths, gravity along an axis, as real arms have them
RandomArm random_arm(std::uint32_t number, bool special, bool only_revolute = false);

}  // namespace torquescope::test
