#pragma once
// Samples at which an encoder cannot tell motion from rest: static friction holds whatever torque is left there.
//
// Equation   those of any window, half a period of the motion's cut-off long, in which the position stays within its
//            resolution
// Units      those of the position; filter: its cut-offs, in Hz
// Threads    pure functions

#include <vector>

#include "engine/data/motion.hpp"

namespace torquescope {

// what the position shows: the encoder's step, or four standard deviations of its noise
double position_resolution(Recording const& recording);

// [n]: 1 where the joint may rest
std::vector<char> quiet_samples(Recording const& recording, FilterOptions const& filter, double resolution);

}  // namespace torquescope
