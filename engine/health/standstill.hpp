#pragma once
// A recording of a joint that does not move: its position shows an encoder's steps and noise, and no motion.
//
// Equation   range of the position below thirty standard deviations of its white noise, or below twenty encoder steps:
//            the range of noise alone over 1e6 samples is ten standard deviations
// Threads    free function

#include "engine/health/examination.hpp"

namespace torquescope {

void find_standstill(Examination& exam);

}  // namespace torquescope
