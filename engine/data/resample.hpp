#pragma once
// Values between unevenly spaced samples: cubic Hermite interpolation with parabolic tangents.
//
// Equation   on [t_i, t_i+1] the cubic with the samples' values and, at each end, the slope of the parabola through
// that
//            sample and its two neighbours (through the three outermost samples at the ends)
// Promise    linear in the values (all channels keep their linear relations); exact for parabolas; passes through the
//            samples; error O(step^3)
// Requires   strictly rising times, at least 3 of them; queries within them and not falling
// Source     de Boor, A Practical Guide to Splines, ch. IV (Bessel interpolation)

#include <span>
#include <vector>

namespace torquescope {

std::vector<double> interpolate(std::span<double const> times, std::span<double const> values,
                                std::span<double const> queries);

}  // namespace torquescope
