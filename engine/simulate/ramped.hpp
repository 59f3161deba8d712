#pragma once
// An oscillation faded in from rest, and scaled to the limits of the joint.
//
// Equation   q(t) = centre + scale * w(t / ramp_s) * p(t),  w(x) = 10 x^3 - 15 x^4 + 6 x^5 for 0 < x < 1, then 1
//            (w, w', w'' are 0 at x = 0: the joint starts at rest without a jump of acceleration)
// Scale      the largest with |q - centre| <= amplitude, |dq| <= max_speed, |ddq| <= max_acceleration

#include <memory>

#include "engine/simulate/reference.hpp"

namespace torquescope {

// highest_hz: of the oscillation; the limits are searched on a grid of 128 points per shortest period
std::unique_ptr<Reference const> ramped_to_limits(std::unique_ptr<Reference const> oscillation, double highest_hz,
                                                  double duration_s, ReferenceOptions const& options);

}  // namespace torquescope
