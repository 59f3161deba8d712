#pragma once
// A robot as `torquescope describe` prints it: tables no wider than the page.

#include <string>

#include "engine/app/terminal/colour.hpp"
#include "engine/experiment/robot_description.hpp"

namespace torquescope {

std::string robot_text(RobotDescription const& robot, Ink const& ink);

}  // namespace torquescope
