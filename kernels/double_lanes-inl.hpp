// Vectors of doubles that divide the eight lanes of a sum (lane_sum.hpp); compiled once per instruction set, so no
// #pragma once.

#include <cstddef>

#include "hwy/highway.h"
#include "kernels/fused-inl.hpp"
#include "kernels/lane_sum.hpp"

#if defined(TORQUESCOPE_KERNELS_DOUBLE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TORQUESCOPE_KERNELS_DOUBLE_LANES_INL
#undef TORQUESCOPE_KERNELS_DOUBLE_LANES_INL
#else
#define TORQUESCOPE_KERNELS_DOUBLE_LANES_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {

using D = hn::CappedTag<double, n_lanes>;
using V = hn::Vec<D>;
inline constexpr D d;
inline constexpr std::size_t vector_lanes = hn::MaxLanes(d);
inline constexpr std::size_t n_vectors = n_lanes / vector_lanes;

HWY_INLINE V set(double value) { return hn::Set(d, value); }

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
