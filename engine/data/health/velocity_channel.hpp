#pragma once
// A velocity column against the derivative of the position beside it: sign, factor, lag, and whether it is the same at
// all.
//
// Compared   both low-passed alike (a mean over some rows), so that encoder steps do not decide
// Left out   whatever contradicts the position: the fit then differentiates the position, and the finding says why
// Threads    free function

#include "engine/data/health/examination.hpp"

namespace torquescope {

// erases the velocity channel (and an acceleration beside it) when it contradicts; needs time_s
void examine_velocity(Examination& exam);

}  // namespace torquescope
