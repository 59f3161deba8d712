#pragma once
// The ends of a robot that one may ask for as the tip of an arm.
//
// Errors     Error 78: no joint moves, several limbs and no tip, a base that floats; each names what to write
// Threads    pure functions

#include <string>
#include <vector>

#include "engine/robot/robot_part.hpp"
#include "engine/robot/robot_tree.hpp"

namespace torquescope {

// links on the way from the root of the file to `link`, without the root
std::vector<std::string> path_to(RobotTree const& tree, std::string link);

// of those links, the joints that move of themselves
std::vector<std::string> moving_joints(RobotTree const& tree, std::vector<std::string> const& path);

// the longest path from `root` that has every moving joint behind it; a tool's frame is at the end of it
std::string only_tip(std::string const& file, RobotTree const& tree, std::string const& root);

}  // namespace torquescope
