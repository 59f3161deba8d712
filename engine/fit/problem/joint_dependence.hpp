#pragma once
// Which joints' torques depend on the motion of which joints of an arm.
//
// Method     the columns of every joint are evaluated at a few postures, and again with another motion of one joint. A
//            slide of a gantry does not feel its neighbour; a joint of a serial arm as a rule feels all
// Shapes     [joint][joint that moves]
// Threads    free function

#include <vector>

#include "engine/fit/problem/arm_model.hpp"

namespace torquescope {

std::vector<std::vector<bool>> motion_dependence(ArmModel const& model);

}  // namespace torquescope
