#pragma once
// Rotations as MJCF writes them: quat, euler, axisangle, xyaxes or zaxis, and none for no rotation.
//
// Errors     Error 78: two of them at once, axes without a direction, with the place
// Source     MuJoCo documentation, "Frame orientations"

#include <Eigen/Core>

#include "engine/robot/mjcf_document.hpp"

namespace torquescope {

Eigen::Matrix3d mjcf_rotation(XmlElement const& element, MjcfCompiler const& compiler);

// the shortest turn of the z axis onto a direction, which need not have length 1
Eigen::Matrix3d turn_of_z_onto(Eigen::Vector3d const& direction);

}  // namespace torquescope
