#pragma once
// What anybody can know of the motion: the recorded position, smoothed and differentiated.
//
// Use        the oracle that a diagnosis can be held against: the true laws along this motion, not along the exact one.
//            An encoder's steps, differentiated twice, are noise that no model removes
// Steps      zero-phase low-pass at position_cutoff_hz, central differences
// Shapes     one value per tick
// Threads    free functions

#include <vector>

#include "concealed/closed_loop.hpp"

namespace concealed {

struct RecordedMotion {
  std::vector<double> v, a;
};

RecordedMotion recorded_motion(Recording const& recording);

// ticks whose neighbourhood of 1.6 / cutoff_hz moves in one direction: nothing of a reversal reaches them through a
// filter
std::vector<char> far_from_reversals(Truth const& truth, double cutoff_hz);

}  // namespace concealed
