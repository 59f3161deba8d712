#include "kernels/prediction_errors.hpp"

#include <cstddef>

#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/prediction_errors.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace {

// neighbouring samples from x on, as many as D has lanes
template <class D>
HWY_INLINE void take_of_neighbours(D d, double const* past, std::size_t order, double gain, double* x) {
  auto const part = [&](std::size_t i) { return hn::Mul(hn::Set(d, past[i]), hn::LoadU(d, x - 1 - i)); };
  auto s0 = hn::Zero(d), s1 = s0, s2 = s0, s3 = s0;
  std::size_t i = 0;
  for (; i + 4 <= order; i += 4) {
    s0 = hn::Add(s0, part(i));
    s1 = hn::Add(s1, part(i + 1));
    s2 = hn::Add(s2, part(i + 2));
    s3 = hn::Add(s3, part(i + 3));
  }
  for (; i < order; ++i) s0 = hn::Add(s0, part(i));
  auto const told = hn::Add(hn::Add(s0, s1), hn::Add(s2, s3));
  hn::StoreU(hn::Mul(hn::Set(d, gain), hn::Sub(hn::LoadU(d, x), told)), d, x);
}

}  // namespace

// from the end, for what stands before a sample is still wanted as it was
void prediction_errors(double const* past, std::size_t order, double gain, double* x, std::size_t n_samples) {
  hn::CappedTag<double, 8> const several;
  hn::CappedTag<double, 1> const one;
  constexpr std::size_t lanes = hn::MaxLanes(several);
  std::size_t left = n_samples;
  for (; left >= lanes; left -= lanes) take_of_neighbours(several, past, order, gain, x + left - lanes);
  for (; left > 0; --left) take_of_neighbours(one, past, order, gain, x + left - 1);
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {
TORQUESCOPE_EXPORT(prediction_errors);
}  // namespace

void take_prediction_errors(double const* past, std::size_t order, double gain, double* x, std::size_t n_samples) {
  TORQUESCOPE_DISPATCH(prediction_errors)(past, order, gain, x, n_samples);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
