// Multiply-add with one rounding on every instruction set; compiled once per instruction set, so no #pragma once.
//
// Why        Highway's MulAdd rounds twice where the hardware has no FMA: other bits. There we call std::fma for each
//            lane, which rounds once in hardware and in software alike; the price is in dispatch.hpp.

#include <cmath>

#include "hwy/highway.h"

#if defined(TORQUESCOPE_KERNELS_FUSED_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TORQUESCOPE_KERNELS_FUSED_INL
#undef TORQUESCOPE_KERNELS_FUSED_INL
#else
#define TORQUESCOPE_KERNELS_FUSED_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// a * b + c
template <class V>
HWY_INLINE V fused_mul_add(V a, V b, V c) {
#if HWY_NATIVE_FMA
  return hn::MulAdd(a, b, c);
#else
  hn::DFromV<V> const d;
  hn::TFromD<hn::DFromV<V> > x[hn::MaxLanes(d)], y[hn::MaxLanes(d)], z[hn::MaxLanes(d)];
  hn::StoreU(a, d, x);
  hn::StoreU(b, d, y);
  hn::StoreU(c, d, z);
  for (std::size_t lane = 0; lane < hn::MaxLanes(d); ++lane) z[lane] = std::fma(x[lane], y[lane], z[lane]);
  return hn::LoadU(d, z);
#endif
}

// c - a * b
template <class V>
HWY_INLINE V fused_neg_mul_add(V a, V b, V c) {
#if HWY_NATIVE_FMA
  return hn::NegMulAdd(a, b, c);
#else
  return fused_mul_add(hn::Neg(a), b, c);
#endif
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
