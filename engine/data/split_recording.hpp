#pragma once
// A recording in two: its head to fit, its tail to judge. No sample is in both, so that no filter carries one into the
// other.
//
// Names      "x.csv (0 to 14 s)" and "x.csv (14 to 20.5 s)", since the first sample
// Threads    free function

#include <utility>

#include "engine/data/recording.hpp"

namespace torquescope {

// Requires   0 < share < 1
std::pair<Recording, Recording> split_recording(Recording const& whole, double share);

}  // namespace torquescope
