#include "kernels/section_cascade.hpp"

#include <cstddef>

#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/section_cascade.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace {

// one section of the signals of one vector
template <class D, class V = hn::Vec<D>>
struct Section {
  V b0, b1, b2, a1, a2, z1, z2;

  HWY_INLINE Section(D d, CascadeSection const& s, V first)
      : b0(hn::Set(d, s.b0)),
        b1(hn::Set(d, s.b1)),
        b2(hn::Set(d, s.b2)),
        a1(hn::Set(d, s.a1)),
        a2(hn::Set(d, s.a2)),
        // states for which a constant input of 1 gives the constant output 1
        z1(hn::Mul(hn::Set(d, 1 - s.b0), first)),
        z2(hn::Mul(hn::Set(d, s.b2 - s.a2), first)) {}

  HWY_INLINE V next(V x) {
    V const y = hn::Add(hn::Mul(b0, x), z1);
    z1 = hn::Add(hn::Sub(hn::Mul(b1, x), hn::Mul(a1, y)), z2);
    z2 = hn::Sub(hn::Mul(b2, x), hn::Mul(a2, y));
    return y;
  }
};

// first: of the first sample in the direction taken
template <std::size_t signals>
void run_one(CascadeSection const& section, double* first, std::size_t n_samples, std::ptrdiff_t step) {
  hn::CappedTag<double, signals> const d;
  for (std::size_t lane = 0; lane < signals; lane += hn::MaxLanes(d)) {
    double* x = first + lane;
    Section one(d, section, hn::LoadU(d, x));
    for (std::size_t i = 0; i < n_samples; ++i, x += step) hn::StoreU(one.next(hn::LoadU(d, x)), d, x);
  }
}

template <std::size_t signals>
void run_two(CascadeSection const* sections, double* first, std::size_t n_samples, std::ptrdiff_t step) {
  hn::CappedTag<double, signals> const d;
  for (std::size_t lane = 0; lane < signals; lane += hn::MaxLanes(d)) {
    double* x = first + lane;
    // in its steady state the first section begins with its input
    Section one(d, sections[0], hn::LoadU(d, x));
    auto y = one.next(hn::LoadU(d, x));
    Section two(d, sections[1], y);
    hn::StoreU(two.next(y), d, x);
    x += step;
    for (std::size_t i = 1; i < n_samples; ++i, x += step) {
      y = one.next(hn::LoadU(d, x));
      hn::StoreU(two.next(y), d, x);
    }
  }
}

template <std::size_t signals>
void cascade_of(CascadeSection const* sections, std::size_t n_sections, double* first, std::size_t n_samples,
                std::ptrdiff_t step) {
  std::size_t k = 0;
  for (; k + 1 < n_sections; k += 2) run_two<signals>(sections + k, first, n_samples, step);
  if (k < n_sections) run_one<signals>(sections[k], first, n_samples, step);
}

}  // namespace

void cascade_2(CascadeSection const* sections, std::size_t n_sections, double* first, std::size_t n_samples,
               std::ptrdiff_t step) {
  cascade_of<2>(sections, n_sections, first, n_samples, step);
}
void cascade_4(CascadeSection const* sections, std::size_t n_sections, double* first, std::size_t n_samples,
               std::ptrdiff_t step) {
  cascade_of<4>(sections, n_sections, first, n_samples, step);
}
void cascade_8(CascadeSection const* sections, std::size_t n_sections, double* first, std::size_t n_samples,
               std::ptrdiff_t step) {
  cascade_of<8>(sections, n_sections, first, n_samples, step);
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {
TORQUESCOPE_EXPORT(cascade_2);
TORQUESCOPE_EXPORT(cascade_4);
TORQUESCOPE_EXPORT(cascade_8);
}  // namespace

void run_cascade(CascadeSection const* sections, std::size_t n_sections, double* samples, std::size_t n_samples,
                 std::size_t signals, CascadeDirection direction) {
  if (n_samples == 0) return;
  auto const width = static_cast<std::ptrdiff_t>(signals);
  bool const forwards = direction == CascadeDirection::forwards;
  double* const first = forwards ? samples : samples + (n_samples - 1) * signals;
  std::ptrdiff_t const step = forwards ? width : -width;
  if (signals == 2)
    TORQUESCOPE_DISPATCH(cascade_2)(sections, n_sections, first, n_samples, step);
  else if (signals == 4)
    TORQUESCOPE_DISPATCH(cascade_4)(sections, n_sections, first, n_samples, step);
  else
    TORQUESCOPE_DISPATCH(cascade_8)(sections, n_sections, first, n_samples, step);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
