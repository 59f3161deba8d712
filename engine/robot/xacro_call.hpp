#pragma once
// A xacro written out by the program xacro, which must be installed; no shell is asked.
//
// Errors     Error 65 with the command to run by hand: no such program, or what the program said; 74: no memory for it
// Threads    waits for the program

#include "engine/robot/robot_text.hpp"

namespace torquescope {

// named "arm.urdf.xacro, written out": lines of messages are those of the URDF
RobotText urdf_of_xacro(RobotText const& text);

}  // namespace torquescope
