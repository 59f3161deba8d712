#pragma once
// The links and joints of a URDF, checked one by one; the only file that knows urdfdom is urdf_tree.cpp.
//
// Errors     Error 65: XML that is no URDF. Error 78: kinds of joints that a serial arm has not, axes without a
//            direction, limits in degrees, a link with two parents (a loop)
// Warnings   elements and attributes that no URDF has (xml_words.hpp)
// Threads    one at a time: urdfdom reports through a global handler
// Source     urdfdom 3.0, http://wiki.ros.org/urdf/XML

#include "engine/robot/robot_tree.hpp"

namespace torquescope {

RobotTree read_urdf_tree(RobotText const& text);

}  // namespace torquescope
