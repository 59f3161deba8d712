#pragma once
// A position that was recorded at equal steps as a motion whose acceleration runs straight from sample to sample.
//
// Why        an effect that integrates the acceleration (a load behind a spring or a gap) must come to where the
//            position says: of central differences, taken twice, 9 % of a wave of 85 Hz is missing at 1 kHz, of this
//            nothing
// Equation   (ddq_{k-1} + 4 ddq_k + ddq_{k+1}) / 6 = (q_{k-1} - 2 q_k + q_{k+1}) / h^2: the cubic spline through the
//            positions; its ends are straight
// Shapes     n >= 3 samples; channels of velocity and acceleration are not looked at
// Units      of the recording
// Threads    free function
// Source     de Boor, A Practical Guide to Splines, 1978, chapter 4

#include "engine/data/motion.hpp"

namespace torquescope {

Motion spline_motion(Recording&& recording);

}  // namespace torquescope
