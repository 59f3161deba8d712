#pragma once
// What the other joints of an arm, or its robot file, may do to one joint: columns of arm_law_choices() on a motion.
//
// Laws       friction and inertia of the neighbours (their recorded motion); gravity_direction and joint_zero (the
//            fitted rigid arm at another gravity, or beside its joint angle): effects/arm_laws
// New law    one file in effects/arm_laws, one name in effects/CMakeLists.txt, one line in the table of arm_laws.cpp
// Shapes     one GivenSignals a joint; columns at the full rate of the motion
// Units      SI
// Threads    free function

#include <vector>

#include "engine/data/given_signals.hpp"
#include "engine/data/motion.hpp"
#include "engine/problem/arm_model.hpp"

namespace torquescope {

// parameters: [R] of the model; motion: of each joint
std::vector<GivenSignals> arm_law_signals(ArmModel const& model, Eigen::VectorXd const& parameters,
                                          std::vector<Motion> const& motion);

}  // namespace torquescope
