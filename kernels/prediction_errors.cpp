#include "kernels/prediction_errors.hpp"

#include <algorithm>
#include <cstddef>

#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/prediction_errors.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#ifndef TORQUESCOPE_KERNELS_PREDICTION_ERRORS
#define TORQUESCOPE_KERNELS_PREDICTION_ERRORS
namespace torquescope::kernels {

// samples first .. first + 7 of a stretch. Of i < first all of them have weights; of the next seven i some have, the
// first four samples as what is left beyond a multiple of four, the others twice: as a part of their sum while i <
// first + 4, as what is left afterwards
inline constexpr std::size_t eight = 8, ends_of_eight = 11;
constexpr std::size_t weights_of_eight(std::size_t first) { return (first + ends_of_eight) * eight; }

}  // namespace torquescope::kernels
#endif

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

// samples first .. first + 7; x: of sample `first`, with seven before the stretch that are 0
void first_prediction_errors(double const* weights, double const* gain, std::size_t first, double const* x,
                             double* out) {
  hn::CappedTag<double, eight> const d;
  for (std::size_t lane = 0; lane < eight; lane += hn::MaxLanes(d)) {
    double const* weight = weights + lane;
    auto const part = [&](std::size_t i) {
      auto const product = hn::Mul(hn::LoadU(d, weight), hn::LoadU(d, x + lane - 1 - i));
      weight += eight;
      return product;
    };
    auto s0 = hn::Zero(d), s1 = s0, s2 = s0, s3 = s0;
    for (std::size_t i = 0; i < first; i += 4) {
      s0 = hn::Add(s0, part(i));
      s1 = hn::Add(s1, part(i + 1));
      s2 = hn::Add(s2, part(i + 2));
      s3 = hn::Add(s3, part(i + 3));
    }
    s0 = hn::Add(s0, part(first));
    s1 = hn::Add(s1, part(first + 1));
    s2 = hn::Add(s2, part(first + 2));
    s3 = hn::Add(s3, part(first + 3));
    for (std::size_t i = 0; i < 7; ++i) s0 = hn::Add(s0, part(first + i));
    auto const told = hn::Add(hn::Add(s0, s1), hn::Add(s2, s3));
    hn::StoreU(hn::Mul(hn::LoadU(d, gain + lane), hn::Sub(hn::LoadU(d, x + lane), told)), d, out + lane);
  }
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {
TORQUESCOPE_EXPORT(prediction_errors);
TORQUESCOPE_EXPORT(first_prediction_errors);
}  // namespace

void take_prediction_errors(double const* past, std::size_t order, double gain, double* x, std::size_t n_samples) {
  TORQUESCOPE_DISPATCH(prediction_errors)(past, order, gain, x, n_samples);
}

FirstPredictionErrors::FirstPredictionErrors(std::vector<std::vector<double>> const& past,
                                             std::vector<double> const& gain)
    : gain_(gain) {
  gain_.resize((gain.size() + eight - 1) / eight * eight, 0.0);
  // weight i of sample m, 0 where it has none or where that one is another term's
  auto const add = [&](std::size_t first, std::size_t i, bool of_parts) {
    for (std::size_t m = first; m < first + eight; ++m) {
      bool const is_there = m < past.size() && i < m && (i < m - m % 4) == of_parts;
      weights_.push_back(is_there ? past[m][i] : 0.0);
    }
  };
  for (std::size_t first = 0; first < past.size(); first += eight) {
    for (std::size_t i = 0; i < first + 4; ++i) add(first, i, true);
    for (std::size_t i = first; i < first + 7; ++i) add(first, i, false);
  }
}

void FirstPredictionErrors::take(double* x, std::size_t n_samples) const {
  std::vector<double> before(eight + gain_.size(), 0.0);
  std::copy_n(x, n_samples, before.begin() + eight);
  auto const kernel = TORQUESCOPE_DISPATCH(first_prediction_errors);
  double const* weights = weights_.data();
  for (std::size_t first = 0; first < n_samples; weights += weights_of_eight(first), first += eight) {
    double out[eight];
    kernel(weights, gain_.data() + first, first, before.data() + eight + first, out);
    std::copy_n(out, std::min(eight, n_samples - first), x + first);
  }
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
