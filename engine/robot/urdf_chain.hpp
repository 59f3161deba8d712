#pragma once
// The arm in a URDF: from its root to a tip, fixed joints merged, what hangs beside it held still.
//
// Frames     modified DH frames (axis_frames.hpp); link inertias in them. The flange is the tip link's frame
// Errors     Error 78: no joint, branches without a tip, joints that follow others of the arm, a link without mass
//            where others have some
// Threads    as urdf_tree.hpp

#include "engine/robot/robot_text.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

// tip: the link where the arm ends; "": the end of the only path with movable joints
SerialChain read_urdf_chain(RobotText const& text, std::string const& tip);

}  // namespace torquescope
