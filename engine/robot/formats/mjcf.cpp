// Robot files in MJCF, MuJoCo's own format.

#include "engine/robot/mjcf_tree.hpp"
#include "engine/robot/robot_chain.hpp"
#include "engine/robot/robot_registry.hpp"
#include "engine/robot/xml_element.hpp"

namespace torquescope::formats {

namespace {

bool accepts(RobotText const& text) { return outermost_element(text) == "mujoco"; }

SerialChain read(RobotText const& text, RobotPart const& part) {
  return chain_of_tree(text.file, read_mjcf_tree(text), part);
}

}  // namespace

RobotFormat mjcf() {
  return {"mjcf", "MuJoCo's format (XML); inertias from <inertial> or from geoms, armatures as drive inertias", true,
          accepts, read};
}

}  // namespace torquescope::formats
