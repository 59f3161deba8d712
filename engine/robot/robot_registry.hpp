#pragma once
// Arms from files. A format is one file in formats/ and one word in CMakeLists.txt.
//
// Errors     Error 66 (no such file), 65 (no robot in it), 78 (a wrong robot), each with place and cure
// Threads    one file at a time: urdfdom reports through a global handler

#include <filesystem>
#include <string>
#include <vector>

#include "engine/robot/robot_part.hpp"
#include "engine/robot/robot_text.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct RobotFormat {
  std::string name;     // "urdf"
  std::string meaning;  // "Unified Robot Description Format"
  bool has_links;       // it names links, so that a part of it may be asked for
  bool (*accepts)(RobotText const&);
  SerialChain (*read)(RobotText const&, RobotPart const&);
};

std::vector<RobotFormat> const& robot_formats();

SerialChain read_robot(std::filesystem::path const& path, RobotPart const& part = {});
// the same of a file that names links, for one that adds something to it
SerialChain read_linked_robot(std::filesystem::path const& path, RobotPart const& part);

}  // namespace torquescope
