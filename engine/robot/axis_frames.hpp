#pragma once
// Modified Denavit-Hartenberg numbers of joint axes that lie anywhere, as a URDF gives them.
//
// Equation   x_i along the common normal of axes i and i + 1, origin i at its foot on axis i; parallel axes: the normal
//            through the foot of the one before. Frame 0 is the root's where axis 1 is the root's z axis
// Units      m, rad; lines seen from the root at q = 0
// Accuracy   axes within 1e-6 rad are parallel; numbers of 1e-12 (times the longest length) are 0
// Source     Khalil and Kleinfinger 1986, doi:10.1109/ROBOT.1986.1087552

#include <Eigen/Core>
#include <vector>

#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct AxisLine {
  Eigen::Vector3d point;
  Eigen::Vector3d direction;  // of length 1
};

// sets chain.base and a, alpha, d, offset of chain.joints, of which there are as many as lines
void set_frames(std::vector<AxisLine> lines, SerialChain& chain);

}  // namespace torquescope
