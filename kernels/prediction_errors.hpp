#pragma once
// What the past of a signal does not tell about it: every sample less a weighted sum of those before it, in place.
//
// Equation   x_k <- gain (x_k - sum_i past_i x_(k-1-i)), i = 0 .. order - 1, with x as it was before the call on the right
// Sum        in four parts, part j of i = j mod 4, which (s0 + s1) + (s2 + s3) joins; what is left of order beyond a multiple of
//            four goes to s0
// Shapes     x: n_samples to change, after `order` more that are only read (x[-order] .. x[-1])
// Bits       the same on every instruction set and for any n_samples: no operation is fused, each sample is its own lane
// Threads    free function; does not allocate

#include <cstddef>

namespace torquescope::kernels {

void take_prediction_errors(double const* past, std::size_t order, double gain, double* x, std::size_t n_samples);

}  // namespace torquescope::kernels
