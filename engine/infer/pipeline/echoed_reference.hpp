#pragma once
// A reference column that is the measured motion itself: prescribed for a model, or logged from the encoder. A
// controller answers the difference between the two; where there is none but rounding or noise, the column tells no
// loop.
//
// Rule       |reference - position| is never more than a step of the encoder; or its difference is white: means of 64
//            rows have at most twice the variance that those of white noise have. A real loop lags: its means differ
//            as its motion does
// Then       the recording counts as one without a reference (recorded_loop.hpp, tracking)
// Threads    free functions

#include "engine/data/recording.hpp"

namespace torquescope {

bool has_echoed_reference(Recording const& recording);

// the recording, without the reference where that is an echo
Recording without_echoed_reference(Recording recording);

}  // namespace torquescope
