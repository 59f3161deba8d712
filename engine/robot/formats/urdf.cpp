// Robot files in URDF, as ROS has them.

#include "engine/robot/robot_chain.hpp"
#include "engine/robot/robot_registry.hpp"
#include "engine/robot/urdf_tree.hpp"
#include "engine/robot/xml_element.hpp"

namespace torquescope::formats {

namespace {

bool accepts(RobotText const& text) { return outermost_element(text) == "robot"; }

SerialChain read(RobotText const& text, RobotPart const& part) {
  return chain_of_tree(text.file, read_urdf_tree(text), part);
}

}  // namespace

RobotFormat urdf() {
  return {"urdf", "Unified Robot Description Format (XML); fixed joints are merged", true, accepts, read};
}

}  // namespace torquescope::formats
