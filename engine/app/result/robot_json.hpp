#pragma once
// A robot as `torquescope describe --json` tells it: {"schema": 1, "robot": {...}}; keys never change their meaning
// within a schema.
//
// Numbers    unrounded, SI; what the file leaves open is null

#include <string>

#include "engine/experiment/robot_description.hpp"

namespace torquescope {

std::string robot_json(RobotDescription const& robot);

}  // namespace torquescope
