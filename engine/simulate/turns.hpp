#pragma once
// sin and cos of an angle given in turns, with the same last bit on every machine (see base/portable_math.hpp).
//
// Turns      one turn is 2 pi; a whole number of turns is taken off exactly, so long recordings lose nothing
// Error      below 2.5e-16 absolute
// Range      |turns| < 2^52
// Bits       the same for every instruction set, for one angle and for many
// Source     fdlibm k_sin, k_cos (polynomials within an eighth of a turn)

#include <span>

namespace torquescope {

double sine_of_turns(double turns);
double cosine_of_turns(double turns);

// the same of many angles, many times as fast; `sines` may be `turns`
void sines_of_turns(std::span<double const> turns, std::span<double> sines);
void sines_cosines_of_turns(std::span<double const> turns, std::span<double> sines, std::span<double> cosines);

// sin(2 pi (f t + phase)) / omega and its derivatives are added to q, dq, ddq, omega = 2 pi f: the bits of one after
// the other of these operations, each rounded alone
struct SineLine {
  double frequency_hz, phase_turns, omega, inverse_omega;
};
void add_sine_line(SineLine const& line, std::span<double const> times_s, std::span<double> q, std::span<double> dq,
                   std::span<double> ddq);

}  // namespace torquescope
