#pragma once
// The bodies and joints of an MJCF file as a tree of links, with what actuators and equalities say of its joints.
//
// Joints     several joints of a body act from the outside in, as they are written; frames between them have no mass
// Errors     Error 65, 66, 78 with file and line: those of mjcf_document.hpp, names that are there twice, elements that
//            only MuJoCo can write out (replicate, attach, composite, flexcomp)
// Warnings   what the rigid arm does not take over: couplings, gravity compensation, unknown words
// Threads    pure functions
// Source     MuJoCo documentation, XML reference; "Kinematic tree"

#include "engine/robot/robot_tree.hpp"

namespace torquescope {

RobotTree read_mjcf_tree(RobotText const& text);

}  // namespace torquescope
