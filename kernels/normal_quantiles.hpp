#pragma once
// Standard normals of many uniforms: the inverse of the normal cumulative distribution.
//
// Bits       those of engine/base/portable_math.hpp's normal_quantile on every instruction set, for any n and any
//            place: the same operations in the same order, none fused
// Range      2^-1000 <= p < 1
// In place   quantiles may be probabilities
// Threads    free function; does not allocate
// Source     Wichura, Algorithm AS 241 (PPND16)

#include <cstddef>

namespace torquescope::kernels {

void normal_quantiles(double const* probabilities, std::size_t n, double* quantiles);

}  // namespace torquescope::kernels
