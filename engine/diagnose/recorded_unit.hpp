#pragma once
// A diagnosis in the unit of the torque that was recorded: in amperes where nobody knows how many N m one makes.
//
// Values     stay as they are: they were in that unit all along, and only effects call it N m
// Twice      the same as once
// Threads    function of its argument

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// units of parameters, of axes and of regions; unit_torque of the joint says which
void tell_in_recorded_unit(JointDiagnosis& joint);

}  // namespace torquescope
