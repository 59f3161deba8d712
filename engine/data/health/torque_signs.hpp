#pragma once
// What a torque channel shows by itself beside the motion: no sign, stretches in which the drive was off.
//
// Without sign   never below zero, and it turns round at zero as often as a magnitude does
// Switched off   nothing but noise for half a second and more while the joint moves, where the torque is else far above
//                it; the rows become missing, and the stretch is left out
// Threads        free functions

#include "engine/data/health/examination.hpp"

namespace torquescope {

void examine_torque_sign(Examination& exam);
// needs time_s
void leave_out_switched_off(Examination& exam);

}  // namespace torquescope
