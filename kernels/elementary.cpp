#include "kernels/elementary.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/elementary.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/double_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace {

using Bits = hn::RebindToSigned<D>;
inline constexpr Bits bits;

// added to |n| < 2^51 it leaves the nearest integer in the last bits
inline constexpr double round_to_integer = 0x1.8p52;

// coefficients[0] + z (coefficients[1] + z (...))
template <std::size_t n>
HWY_INLINE V polynomial(V z, double const (&coefficients)[n]) {
  V value = set(coefficients[n - 1]);
  for (std::size_t k = n - 1; k-- > 0;) value = fused_mul_add(value, z, set(coefficients[k]));
  return value;
}

// 2^n of an integer n with round_to_integer added; -1022 <= n <= 1023
HWY_INLINE V two_to(V shifted) {
  auto const exponent = hn::ShiftLeft<52>(hn::BitCast(bits, shifted));
  return hn::BitCast(d, hn::Add(exponent, hn::Set(bits, std::int64_t{1023} << 52)));
}

// e^(x + tail), tail below 2^-40
HWY_INLINE V exp_of_sum(V x, V tail) {
  // beyond these the result is infinite or zero
  x = hn::IfThenElse(hn::Gt(x, set(710.0)), set(710.0), x);
  x = hn::IfThenElse(hn::Lt(x, set(-746.0)), set(-746.0), x);

  // x + tail = n ln 2 + r + small, |r| <= ln 2 / 2; the first product is exact, the second one's rounding is kept
  V const shift = set(round_to_integer);
  V const n = hn::Sub(fused_mul_add(x, set(0x1.71547652b82fep0), shift), shift);
  V const near = fused_neg_mul_add(n, set(0x1.62e42fefa39efp-1), x);
  V const low = set(0x1.abc9e3b39803fp-56);
  V const reduced = fused_neg_mul_add(n, low, near);
  tail = hn::Add(tail, fused_neg_mul_add(n, low, hn::Sub(near, reduced)));
  V const r = hn::Add(reduced, tail);
  V small = hn::Add(hn::Sub(reduced, r), tail);
  small = fused_mul_add(small, r, small);

  // Taylor to r^13 / 13!: the rest is below 2^-57. 1 + r is added without loss
  static constexpr double inverse_factorials[] = {1.0 / 2,       1.0 / 6,        1.0 / 24,        1.0 / 120,
                                                  1.0 / 720,     1.0 / 5040,     1.0 / 40320,     1.0 / 362880,
                                                  1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
  V const one_and_r = hn::Add(set(1.0), r);
  V const lost = hn::Add(hn::Sub(set(1.0), one_and_r), r);
  V const rest = fused_mul_add(hn::Mul(r, r), polynomial(r, inverse_factorials), hn::Add(lost, small));
  V const value = hn::Add(one_and_r, rest);

  // 2^n in two factors: n runs from -1076 to 1024
  V const half = fused_mul_add(n, set(0.5), shift);
  V const other_half = hn::Add(hn::Sub(n, hn::Sub(half, shift)), shift);
  return hn::Mul(hn::Mul(value, two_to(half)), two_to(other_half));
}

struct Sum {
  V value, tail;
};

// a + b without loss (Knuth)
HWY_INLINE Sum sum_of(V a, V b) {
  V const value = hn::Add(a, b), added = hn::Sub(value, a);
  return {value, hn::Add(hn::Sub(a, hn::Sub(value, added)), hn::Sub(b, added))};
}

// log(x) of positive finite x, tail to about 2^-64 of it
HWY_INLINE Sum log_of(V x) {
  auto const is_subnormal = hn::Lt(x, set(std::numeric_limits<double>::min()));
  x = hn::IfThenElse(is_subnormal, hn::Mul(x, set(0x1p54)), x);

  // x = 2^k m, sqrt(1/2) <= m < sqrt(2)
  auto const of_x = hn::BitCast(bits, x);
  auto const exponent = hn::ShiftRight<52>(hn::Sub(of_x, hn::Set(bits, std::int64_t{0x3fe6a09e667f3bcd})));
  V const m = hn::BitCast(d, hn::Sub(of_x, hn::ShiftLeft<52>(exponent)));
  auto const integer = hn::BitCast(bits, set(round_to_integer));
  V k = hn::Sub(hn::BitCast(d, hn::Add(exponent, integer)), set(round_to_integer));
  k = hn::IfThenElse(is_subnormal, hn::Sub(k, set(54.0)), k);

  // s + s_tail = (m - 1) / (m + 1)
  V const above = hn::Sub(m, set(1.0)), below = hn::Add(m, set(1.0));
  V const below_tail = hn::Sub(m, hn::Sub(below, set(1.0)));
  V const inverse = hn::Div(set(1.0), below);
  V const s = hn::Mul(above, inverse);
  V const left = fused_neg_mul_add(s, below_tail, fused_neg_mul_add(s, below, above));
  V const s_tail = hn::Mul(left, inverse);

  // log m = 2 (s + s^3 / 3 + s^5 (1/5 + s^2 / 7 + ...)), the cube with its tail
  V const square = hn::Mul(s, s);
  V const square_tail = fused_mul_add(hn::Add(s, s), s_tail, fused_mul_add(s, s, hn::Neg(square)));
  V const cube = hn::Mul(square, s);
  V const cube_tail =
      fused_mul_add(square_tail, s, fused_mul_add(square, s_tail, fused_mul_add(square, s, hn::Neg(cube))));
  V const third = set(0x1.5555555555555p-2), third_tail = set(0x1.5555555555555p-56);
  V const second = hn::Mul(cube, third);
  V const second_tail =
      fused_mul_add(cube_tail, third, fused_mul_add(cube, third_tail, fused_mul_add(cube, third, hn::Neg(second))));
  static constexpr double inverse_odds[] = {1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11, 1.0 / 13, 1.0 / 15,
                                            1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23, 1.0 / 25, 1.0 / 27};
  V const others = hn::Mul(hn::Mul(cube, square), polynomial(square, inverse_odds));

  // k ln 2 in front, its high part of 42 bits: each sum goes from the larger to the smaller
  V const turns = hn::Mul(k, set(0x1.62e42fefa38p-1));
  V const two = set(2.0);
  V const first = fused_mul_add(two, s, turns);
  V const first_tail = fused_mul_add(two, s, hn::Sub(turns, first));
  V const both = fused_mul_add(two, second, first);
  V tail = fused_mul_add(two, second, hn::Sub(first, both));
  tail = hn::Add(tail, fused_mul_add(k, set(0x1.ef35793c7673p-45), first_tail));
  tail = hn::Add(tail, hn::Mul(two, hn::Add(others, hn::Add(s_tail, second_tail))));
  V const value = hn::Add(both, tail);
  return {value, hn::Add(hn::Sub(both, value), tail)};
}

HWY_INLINE V logarithm_of(V x) {
  double const infinity = std::numeric_limits<double>::infinity();
  V result = log_of(x).value;
  result = hn::IfThenElse(hn::Eq(x, hn::Zero(d)), set(-infinity), result);
  result = hn::IfThenElse(hn::Eq(x, set(infinity)), x, result);
  result = hn::IfThenElse(hn::Lt(x, hn::Zero(d)), set(std::numeric_limits<double>::quiet_NaN()), result);
  return hn::IfThenElse(hn::Eq(x, x), result, x);
}

HWY_INLINE V power_of_size_of(V x, V a) {
  V const size = hn::Abs(x);
  Sum const log = log_of(size);
  V const y = hn::Mul(a, log.value);
  V const y_tail = fused_mul_add(a, log.tail, fused_mul_add(a, log.value, hn::Neg(y)));
  // of an infinite y the tail is no number
  V result = exp_of_sum(y, hn::IfThenElseZero(hn::Lt(hn::Abs(y), set(746.0)), y_tail));
  V const zero = hn::Zero(d), one = set(1.0), infinity = set(std::numeric_limits<double>::infinity());
  auto const grows = hn::Gt(a, zero), falls = hn::Lt(a, zero);
  V const at_zero = hn::IfThenElse(grows, zero, hn::IfThenElse(falls, infinity, one));
  V const at_infinity = hn::IfThenElse(grows, infinity, hn::IfThenElse(falls, zero, one));
  result = hn::IfThenElse(hn::Eq(size, zero), at_zero, result);
  result = hn::IfThenElse(hn::Eq(size, infinity), at_infinity, result);
  return hn::IfThenElse(hn::Eq(x, x), result, x);
}

struct CosineSine {
  V cosine, sine;
};

HWY_INLINE CosineSine cosine_sine_of(V factor, V x) {
  V const phase = hn::Mul(factor, x);
  V const phase_tail = fused_mul_add(factor, x, hn::Neg(phase));

  // phase = n pi / 2 + r + tail in three parts of pi / 2: the first product leaves an exact difference, near a zero
  // the others cancel most of that, so that no rounding may be lost
  V const shift = set(round_to_integer);
  V const shifted = fused_mul_add(phase, set(0x1.45f306dc9c883p-1), shift);
  V const n = hn::Sub(shifted, shift);
  V const near = fused_neg_mul_add(n, set(0x1.921fb54442d18p0), phase);
  V const minus_n = hn::Neg(n), part = set(0x1.1a62633145c07p-54);
  V const turned = hn::Mul(minus_n, part);
  V const turned_tail = fused_mul_add(minus_n, part, hn::Neg(turned));
  Sum const whole = sum_of(near, phase_tail);
  Sum const reduced = sum_of(whole.value, turned);
  V tail = hn::Add(reduced.tail, hn::Add(whole.tail, turned_tail));
  tail = fused_neg_mul_add(n, set(-0x1.f1976b7ed8fbcp-110), tail);
  V const r = hn::Add(reduced.value, tail);
  tail = hn::Add(hn::Sub(reduced.value, r), tail);

  V const square = hn::Mul(r, r), cube = hn::Mul(square, r);
  static constexpr double of_sine[] = {8.33333333332248946124e-03, -1.98412698298579493134e-04,
                                       2.75573137070700676789e-06, -2.50507602534068634195e-08,
                                       1.58969099521155010221e-10};
  // tail (1 - r^2 / 2) + r^5 (...) - r^3 / 6
  V const later = fused_neg_mul_add(square, hn::Mul(set(0.5), tail), tail);
  V const fifth = fused_mul_add(hn::Mul(cube, square), polynomial(square, of_sine), later);
  V const sine = hn::Add(r, fused_mul_add(cube, set(-1.66666666666666324348e-01), fifth));

  static constexpr double of_cosine[] = {4.16666666666666019037e-02, -1.38888888888741095749e-03,
                                         2.48015872894767294178e-05, -2.75573143513906633035e-07,
                                         2.08757232129817482790e-09, -1.13596475577881948265e-11};
  V const half = hn::Mul(set(0.5), square);
  V const first = hn::Sub(set(1.0), half);
  V const first_tail = hn::Sub(hn::Sub(set(1.0), first), half);
  V const fourth = hn::Mul(hn::Mul(square, square), polynomial(square, of_cosine));
  V const cosine = hn::Add(first, hn::Add(first_tail, fused_neg_mul_add(r, tail, fourth)));

  // quarter turns: odd ones exchange the two, then each has its sign
  auto const quarter = hn::BitCast(bits, shifted);
  auto const one = hn::Set(bits, std::int64_t{1});
  auto const is_odd = hn::MaskFromVec(hn::BitCast(d, hn::Neg(hn::And(quarter, one))));
  auto const sign = [&](auto turns) { return hn::BitCast(d, hn::ShiftLeft<62>(hn::And(turns, hn::Set(bits, 2)))); };
  V const c = hn::Xor(hn::IfThenElse(is_odd, sine, cosine), sign(hn::Add(quarter, one)));
  V const s = hn::Xor(hn::IfThenElse(is_odd, cosine, sine), sign(quarter));
  auto const has_phase = hn::Le(hn::Abs(phase), set(0x1p45));
  V const none = set(std::numeric_limits<double>::quiet_NaN());
  return {hn::IfThenElse(has_phase, c, none), hn::IfThenElse(has_phase, s, none)};
}

// function(vector, where its results go) for whole vectors, then for the rest in a vector of its own
template <class Function>
HWY_INLINE void for_each_vector(double const* x, std::size_t n, Function const& function) {
  std::size_t i = 0;
  for (; i + vector_lanes <= n; i += vector_lanes) function(hn::LoadU(d, x + i), i, vector_lanes);
  if (i == n) return;
  double padded[vector_lanes] = {};
  std::copy_n(x + i, n - i, padded);
  function(hn::LoadU(d, padded), i, n - i);
}

// the same of two arrays
template <class Function>
HWY_INLINE void for_each_pair(double const* x, double const* y, std::size_t n, Function const& function) {
  std::size_t i = 0;
  for (; i + vector_lanes <= n; i += vector_lanes) function(hn::LoadU(d, x + i), hn::LoadU(d, y + i), i, vector_lanes);
  if (i == n) return;
  double padded_x[vector_lanes] = {}, padded_y[vector_lanes] = {};
  std::copy_n(x + i, n - i, padded_x);
  std::copy_n(y + i, n - i, padded_y);
  function(hn::LoadU(d, padded_x), hn::LoadU(d, padded_y), i, n - i);
}

HWY_INLINE void store(V value, std::size_t count, double* out) {
  if (count == vector_lanes) return hn::StoreU(value, d, out);
  double padded[vector_lanes];
  hn::StoreU(value, d, padded);
  std::copy_n(padded, count, out);
}

}  // namespace

void exponential_of_array(double const* x, std::size_t n, double* out) {
  for_each_vector(x, n,
                  [&](V v, std::size_t i, std::size_t count) { store(exp_of_sum(v, hn::Zero(d)), count, out + i); });
}

void logarithm_of_array(double const* x, std::size_t n, double* out) {
  for_each_vector(x, n, [&](V v, std::size_t i, std::size_t count) { store(logarithm_of(v), count, out + i); });
}

void power_of_array(double const* x, double exponent, std::size_t n, double* out) {
  V const a = set(exponent);
  for_each_vector(x, n, [&](V v, std::size_t i, std::size_t count) { store(power_of_size_of(v, a), count, out + i); });
}

void powers_of_array(double const* x, double const* exponents, std::size_t n, double* out) {
  for_each_pair(x, exponents, n,
                [&](V v, V a, std::size_t i, std::size_t count) { store(power_of_size_of(v, a), count, out + i); });
}

void cosine_sine_of_array(double factor, double const* x, std::size_t n, double* cosine, double* sine) {
  V const times = set(factor);
  for_each_vector(x, n, [&](V v, std::size_t i, std::size_t count) {
    CosineSine const both = cosine_sine_of(times, v);
    store(both.cosine, count, cosine + i);
    store(both.sine, count, sine + i);
  });
}

void cosines_sines_of_array(double const* factors, double const* x, std::size_t n, double* cosine, double* sine) {
  for_each_pair(x, factors, n, [&](V v, V times, std::size_t i, std::size_t count) {
    CosineSine const both = cosine_sine_of(times, v);
    store(both.cosine, count, cosine + i);
    store(both.sine, count, sine + i);
  });
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {
TORQUESCOPE_EXPORT(exponential_of_array);
TORQUESCOPE_EXPORT(logarithm_of_array);
TORQUESCOPE_EXPORT(power_of_array);
TORQUESCOPE_EXPORT(powers_of_array);
TORQUESCOPE_EXPORT(cosine_sine_of_array);
TORQUESCOPE_EXPORT(cosines_sines_of_array);
}  // namespace

void exponential(double const* x, std::size_t n, double* out) { TORQUESCOPE_DISPATCH(exponential_of_array)(x, n, out); }

void logarithm(double const* x, std::size_t n, double* out) { TORQUESCOPE_DISPATCH(logarithm_of_array)(x, n, out); }

void power_of_size(double const* x, double exponent, std::size_t n, double* out) {
  TORQUESCOPE_DISPATCH(power_of_array)(x, exponent, n, out);
}

void power_of_size(double const* x, double const* exponents, std::size_t n, double* out) {
  TORQUESCOPE_DISPATCH(powers_of_array)(x, exponents, n, out);
}

void cosine_sine_of_multiple(double factor, double const* x, std::size_t n, double* cosine, double* sine) {
  TORQUESCOPE_DISPATCH(cosine_sine_of_array)(factor, x, n, cosine, sine);
}

void cosine_sine_of_multiple(double const* factors, double const* x, std::size_t n, double* cosine, double* sine) {
  TORQUESCOPE_DISPATCH(cosines_sines_of_array)(factors, x, n, cosine, sine);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
