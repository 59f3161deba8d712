#pragma once
// The step of the encoder that a position was read with, as the recording shows it.
//
// Equation   the step of which all differences are multiples (signal_facts.hpp); where printed digits, a change of
//            units or an unwrapped turn blur it, the median jump behind a value that was held, if three of four such
//            jumps are about as large. A joint that creeps jumps by single steps; a slow source by what it has moved
// Units      those of the values; 0: none is seen
// Threads    pure functions

#include <span>

#include "engine/data/recording.hpp"

namespace torquescope {

double shown_step(std::span<double const> positions);
// what reading the file has found, else what the position shows
double encoder_step(Recording const& recording);

}  // namespace torquescope
