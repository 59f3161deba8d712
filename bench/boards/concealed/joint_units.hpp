#pragma once
// The engine's words for units of a joint that turns or slides.

#include <string>

#include "concealed/rig.hpp"

namespace concealed {

inline std::string torque_unit(JointDesign const& joint) { return joint.revolute ? "N m" : "N"; }
inline std::string position_unit(JointDesign const& joint) { return joint.revolute ? "rad" : "m"; }
inline std::string inertia_unit(JointDesign const& joint) { return joint.revolute ? "kg m2" : "kg"; }
inline std::string order_unit(JointDesign const& joint) { return "1/" + position_unit(joint); }

}  // namespace concealed
