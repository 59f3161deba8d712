#pragma once
// The links and joints of a URDF, checked one by one; the only file that knows urdfdom is urdf_tree.cpp.
//
// Errors     Error 65: XML that is no URDF. Error 78: kinds of joints that a serial arm has not, axes that have not
//            length 1, limits in degrees, a link with two parents (a loop)
// Threads    one at a time: urdfdom reports through a global handler
// Source     urdfdom 3.0, http://wiki.ros.org/urdf/XML

#include <map>
#include <string>
#include <vector>

#include "engine/robot/robot_text.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct UrdfJoint {
  ChainJoint joint{};  // name, kind, limits
  bool is_fixed = false;
  std::string mimics{};  // the joint it follows
  std::string parent{}, child{};
  FramePose origin{};  // seen from the parent link
  Eigen::Vector3d axis{1.0, 0.0, 0.0};

  bool moves_itself() const { return !is_fixed && mimics.empty(); }
};

struct UrdfTree {
  std::string name{}, root{};
  std::map<std::string, UrdfJoint> joint_to{};                 // by child link
  std::map<std::string, std::vector<std::string>> children{};  // by parent link, in the order of names
  std::map<std::string, LinkInertia> inertias{};               // in the link's frame; links without one are left out
  std::vector<std::string> remarks{};
};

UrdfTree read_urdf_tree(RobotText const& text);

// where <joint name="elbow"> or <link name="forearm"> begins, or where <axis of it does
SourcePlace urdf_place(RobotText const& text, std::string const& element, std::string const& name,
                       std::string const& inner = "");

}  // namespace torquescope
