#pragma once
// The arm in a tree of links: from a root to a tip, fixed joints merged, what hangs beside it held still.
//
// Frames     modified DH frames (axis_frames.hpp); link inertias in them. The flange is the tip link's frame
// Errors     Error 78: no joint, branches without a tip (the ends are named), a base that floats, joints that follow
//            others of the arm, a link without mass where others have some
// Threads    pure function

#include "engine/robot/robot_part.hpp"
#include "engine/robot/robot_tree.hpp"

namespace torquescope {

// file: as it is named in messages
SerialChain chain_of_tree(std::string const& file, RobotTree const& tree, RobotPart const& part);

}  // namespace torquescope
