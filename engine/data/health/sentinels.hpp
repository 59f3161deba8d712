#pragma once
// Sentinels of a driver or a sensor without an answer (far_values.hpp): their cells become missing, and are said.
//
// Requires   before registers are decoded and positions unwrapped: outside; after it, with single wrong rows filled:
//            inside, for a position that wraps is on both sides of its modulus in turns
// Threads    free functions

#include "engine/data/health/examination.hpp"

namespace torquescope {

void examine_values_outside(Examination& exam);
// of "position" or "torque"
void examine_values_inside(Examination& exam, std::string const& channel);

}  // namespace torquescope
