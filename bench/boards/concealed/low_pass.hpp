#pragma once
// Zero-phase low-pass: two second-order Butterworth sections, forwards and backwards, started at the end values.
//
// Gain       -6 dB at cutoff_hz (two passes of -3 dB)
// Units      cutoff_hz, rate_hz in Hz; cutoff_hz below half the rate

#include <vector>

namespace concealed {

std::vector<double> low_passed(std::vector<double> values, double cutoff_hz, double rate_hz);

}  // namespace concealed
