#pragma once
// Arms from files. A format is one file in formats/ and one word in CMakeLists.txt.
//
// Errors     Error 66 (no such file), 65 (no robot in it), 78 (a wrong robot), each with place and cure
// Threads    one file at a time: urdfdom reports through a global handler

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/robot/robot_part.hpp"
#include "engine/robot/robot_text.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

// the same numbers, read in the Denavit-Hartenberg convention that the file does not name
struct OtherConvention {
  std::string name;  // "standard_dh"
  SerialChain chain;
};

struct RobotFormat {
  std::string name;     // "urdf"
  std::string meaning;  // "Unified Robot Description Format"
  bool has_links;       // it names links, so that a part of it may be asked for
  bool (*accepts)(RobotText const&);
  SerialChain (*read)(RobotText const&, RobotPart const&);
  std::optional<OtherConvention> (*read_otherwise)(RobotText const&) = nullptr;  // nullptr: it knows one convention
};

std::vector<RobotFormat> const& robot_formats();

SerialChain read_robot(std::filesystem::path const& path, RobotPart const& part = {});
// the same of a file that names links, for one that adds something to it
SerialChain read_linked_robot(std::filesystem::path const& path, RobotPart const& part);

// empty where the file has no such numbers. Requires a file that read_robot() reads
std::optional<OtherConvention> read_robot_otherwise(std::filesystem::path const& path);

}  // namespace torquescope
