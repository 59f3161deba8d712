// Robot files in xacro, from which the program of that name makes a URDF.

#include "engine/robot/robot_chain.hpp"
#include "engine/robot/robot_registry.hpp"
#include "engine/robot/urdf_tree.hpp"
#include "engine/robot/xacro_call.hpp"
#include "engine/robot/xml_element.hpp"

namespace torquescope::formats {

namespace {

// a URDF may keep the name space of the xacro that it was made from
bool accepts(RobotText const& text) {
  return outermost_element(text) == "robot" &&
         (text.text.find("<xacro:") != std::string::npos || std::filesystem::path(text.file).extension() == ".xacro");
}

SerialChain read(RobotText const& text, RobotPart const& part) {
  auto const urdf = urdf_of_xacro(text);
  return chain_of_tree(urdf.file, read_urdf_tree(urdf), part);
}

}  // namespace

RobotFormat xacro() { return {"xacro", "macros for URDF; the program xacro writes them out", true, accepts, read}; }

}  // namespace torquescope::formats
