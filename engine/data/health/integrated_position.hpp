#pragma once
// A recording with a velocity and no position: the position is the velocity's integral, zero at the first row.
//
// Equation   q_0 = 0, q_k = q_(k-1) + (v_k + v_(k-1)) / 2 (t_k - t_(k-1)) over rows with a velocity
// Unknown    where the joint stood: what depends on it (phase of gravity, rest of a spring) is told up to the start
// Channels   position takes the velocity's place, in units of the position columns
// Findings   position_integrated; unit_in_name (fault) where the velocity's name tells a unit and the job no factor
// Threads    one recording, one thread

#include "engine/data/health/examination.hpp"

namespace torquescope {

// Requires   a channel velocity and none of the position; times of the rows known, or rate_hz
void integrate_velocity(Examination& exam);

}  // namespace torquescope
