#pragma once
// A recording at another sampling rate: recordings of one job share one.
//
// Method     low-passed (zero phase, 0.4 of the new rate) where the new rate is below nine tenths of the old one, then
//            interpolated (resample.hpp)
// Requires   rate_hz > 0
// Threads    free function

#include "engine/data/recording.hpp"

namespace torquescope {

Recording at_rate(Recording recording, double rate_hz);

}  // namespace torquescope
