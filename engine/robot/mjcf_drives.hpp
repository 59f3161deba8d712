#pragma once
// What the actuators and the equalities of an MJCF file say of its joints: gears, greatest torques, couplings.
//
// Gear       the force at the joint is gear times that of the actuator. A motor whose control goes from -1 to 1 has no
//            gear but a greatest torque
// Errors     Error 78: a joint that is not there, with the place
// Source     MuJoCo documentation, XML reference: actuator, equality

#include "engine/robot/mjcf_document.hpp"
#include "engine/robot/robot_tree.hpp"

namespace torquescope {

void read_mjcf_drives(MjcfDocument const& document, RobotTree& tree);

}  // namespace torquescope
