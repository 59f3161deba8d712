#pragma once
// Arms from files. A format is one file in formats/ and one word in CMakeLists.txt.
//
// Errors     Error 66 (no such file), 65 (no robot in it), 78 (a wrong robot), each with place and cure
// Threads    one file at a time: urdfdom reports through a global handler

#include <filesystem>
#include <string>
#include <vector>

#include "engine/robot/robot_text.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct RobotFormat {
  std::string name;     // "urdf"
  std::string meaning;  // "Unified Robot Description Format"
  bool (*accepts)(RobotText const&);
  SerialChain (*read)(RobotText const&);
};

std::vector<RobotFormat> const& robot_formats();

SerialChain read_robot(std::filesystem::path const& path);

}  // namespace torquescope
