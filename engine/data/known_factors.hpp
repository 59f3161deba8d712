#pragma once
// Factors between a signal and what it was taken for that people forget: degrees, turns, rpm, a sign, thousandths.
//
// Equation   right = factor * written
// Source     definitions: a turn is 2 pi rad, 360 degrees, 400 gon; rpm are turns per minute
// Threads    free functions

#include <string>
#include <vector>

namespace torquescope {

struct KnownFactor {
  double factor;      // SI units per unit of what was written
  std::string words;  // "degrees"
};

std::vector<KnownFactor> const& angle_factors();  // of a position that was taken as rad; the sign is one of them
std::vector<KnownFactor> const& speed_factors();  // of a velocity that was taken as rad/s

// the one within `tolerance` (relative) of factor; nullptr: none
KnownFactor const* nearest_known(std::vector<KnownFactor> const& known, double factor, double tolerance);

}  // namespace torquescope
