#pragma once
// sin and cos of an angle given in turns, with the same last bit on every machine (see base/portable_math.hpp).
//
// Turns      one turn is 2 pi; a whole number of turns is taken off exactly, so long recordings lose nothing
// Error      below 4e-16 absolute
// Range      |turns| < 2^52

#include <span>

namespace torquescope {

double sine_of_turns(double turns);
double cosine_of_turns(double turns);

// the same of many angles, several times as fast
void sines_of_turns(std::span<double const> turns, std::span<double> sines);
// to angles whose sines are the cosines of these
void quarter_ahead(std::span<double> turns);

}  // namespace torquescope
