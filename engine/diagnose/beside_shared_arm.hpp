#pragma once
// The outcome of a joint that was searched beside a rigid arm refitted to what its effects leave, in terms of the arm
// as it was fitted alone: only that arm is what the user has without the effects.
//
// Before     errors of the rigid arm alone. Beside effects that are left out again, the refitted one is worse
// Names      stand where their error is clearly lower than that, by as much as a verdict names: a paired test over
//            blocks of the validation recordings (held_out_gain.hpp); without any, the cross-validated error
// None       the outcome of the arm alone
// Shapes     traces of both outcomes: the same recordings and rows
// Threads    pure function

#include "engine/diagnose/joint_diagnosis.hpp"

namespace torquescope {

// memory: rows that a filter couples
JointOutcome beside_shared_arm(JointOutcome const& alone, JointOutcome refitted, DecisionLevels const& levels,
                               Eigen::Index memory);

}  // namespace torquescope
