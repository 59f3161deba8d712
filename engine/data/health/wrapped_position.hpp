#pragma once
// A position that is logged modulo something: 2 pi, 360 degrees, a counter of 2^k. Unwrapped where nothing else fits.
//
// Corrected  jumps of one known modulus (or recording.wrap), and without it the motion goes on; the reference alike
// Fault      jumps that all have one size, which is the range of the position: the modulus must be given
// Threads    free function

#include "engine/data/health/examination.hpp"

namespace torquescope {

void unwrap_position(Examination& exam);

}  // namespace torquescope
