#pragma once
// Butterworth low-pass as second-order sections.
//
// Equation   |H(f)|^2 = 1 / (1 + (tan(pi f/f_s) / tan(pi f_c/f_s))^(2 order)): bilinear transform, pre-warped at f_c
// Section    y_k = b0 x_k + b1 x_k-1 + b2 x_k-2 - a1 y_k-1 - a2 y_k-2; each has gain 1 at f = 0
// Requires   0 < cutoff_hz < rate_hz / 2, order >= 1
// Source     Oppenheim, Schafer: Discrete-Time Signal Processing, 7.1; equal to scipy.signal.butter(output="sos") up to
//            where the gain stands (there all of it in the first section)

#include <vector>

#include "kernels/section_cascade.hpp"

namespace torquescope {

// a0 = 1; an odd order ends with a section of order one (b2 = a2 = 0)
using FilterSection = kernels::CascadeSection;

std::vector<FilterSection> butterworth_lowpass(int order, double cutoff_hz, double rate_hz);

}  // namespace torquescope
