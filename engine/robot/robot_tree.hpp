#pragma once
// A robot as its file has it: links, and a joint to each of them but the root. Readers of XML formats make it, and
// robot_chain.hpp takes an arm out of it.
//
// Frames     origin: the joint's frame seen from its parent link; the child's frame is the joint's, moved by it
// Units      SI
// Threads    plain records

#include <map>
#include <string>
#include <vector>

#include "engine/robot/robot_text.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

enum class JointMotion { fixed, moves, floats };  // floats: any motion of more than one direction

struct TreeJoint {
  ChainJoint joint{};  // name, kind, limits, drive
  JointMotion motion = JointMotion::fixed;
  std::string mimics{};  // the joint it follows
  std::string parent{}, child{};
  FramePose origin{};
  Eigen::Vector3d axis{1.0, 0.0, 0.0};
  double position_of_file = 0.0;       // what the joint reads in the pose of the file, rad or m
  bool is_part_of_one = false;         // the child is but a frame between two joints of one body: it has no mass
  std::vector<std::string> remarks{};  // what the reader did on its own
  std::vector<std::string> effects{};  // "damping 0.5": what the file says of it beside the rigid arm
  SourcePlace place{};

  bool moves_itself() const { return motion == JointMotion::moves && mimics.empty(); }
};

// an equation of the file between two joints, or between one and a number (then `second` is empty)
struct JointCoupling {
  std::string first{}, second{};
  SourcePlace place{};
};

struct RobotTree {
  std::string name{}, root{};
  std::map<std::string, TreeJoint> joint_to{};                 // by child link
  std::map<std::string, std::vector<std::string>> children{};  // by parent link, in the order of names
  std::map<std::string, LinkInertia> inertias{};               // in the link's frame; links without one are left out
  std::map<std::string, std::string> unknown_inertias{};  // links that have a mass of which the file says too little
  std::vector<JointCoupling> couplings{};
  Eigen::Vector3d gravity{0.0, 0.0, -9.81};  // m/s^2 in the root's frame
  std::vector<std::string> remarks{}, warnings{};
};

}  // namespace torquescope
