#include "engine/simulate/turns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/contract.hpp"
#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simulate/turns.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace torquescope::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Vector = hn::Vec<Doubles>;

// a / b for a whole number b below 512, rounded like the division. With y = 1 / b rounded, q = a y is within two units in
// the last place of the quotient, a - q b is exact, and one correction leaves an error far below 1 / (2 b) of a unit: no
// quotient of a double by such a b is nearer than that to the middle between two doubles. Only where there is no
// fused multiply-add, and for quotients below the normal numbers (whose sine is its argument), is it the division itself
HWY_INLINE Vector divided(Vector a, double b) {
  Doubles const d;
#if HWY_NATIVE_FMA
  Vector const inverse = hn::Set(d, 1.0 / b);
  Vector const quotient = hn::Mul(a, inverse);
  Vector const rest = hn::NegMulAdd(quotient, hn::Set(d, b), a);
  return hn::MulAdd(rest, inverse, quotient);
#else
  return hn::Div(a, hn::Set(d, b));
#endif
}

// by the nearer whole turn; 0 is added so that -0 becomes 0
HWY_INLINE Vector within_half_a_turn(Vector turns) {
  Doubles const d;
  Vector const rest = hn::Sub(turns, hn::Floor(hn::Add(turns, hn::Set(d, 0.5))));
  return hn::Add(rest, hn::Zero(d));
}

template <std::size_t n_vectors>
HWY_INLINE void sines_of_vectors(Vector (&values)[n_vectors]) {
  Doubles const d;
  Vector const one = hn::Set(d, 1.0), quarter = hn::Set(d, 0.25), half = hn::Set(d, 0.5);
  Vector x[n_vectors], negative_square[n_vectors], sum[n_vectors];
  for (std::size_t i = 0; i < n_vectors; ++i) {
    // one turn about zero, then the quarter in which the series is short: sin(pi - x) = sin(x)
    Vector rest = within_half_a_turn(values[i]);
    rest = hn::IfThenElse(hn::Gt(rest, quarter), hn::Sub(half, rest), rest);
    rest = hn::IfThenElse(hn::Lt(rest, hn::Neg(quarter)), hn::Sub(hn::Neg(half), rest), rest);
    x[i] = hn::Mul(hn::Set(d, 2.0 * std::numbers::pi), rest);
    negative_square[i] = hn::Neg(hn::Mul(x[i], x[i]));
    sum[i] = hn::Zero(d);
  }
  // x - x^3/3! + ... to x^23: below 1e-20 at a quarter turn
  for (int n = 22; n >= 2; n -= 2) {
    double const factor = n * (n + 1);
    for (std::size_t i = 0; i < n_vectors; ++i)
      sum[i] = divided(hn::Mul(hn::Add(sum[i], one), negative_square[i]), factor);
  }
  for (std::size_t i = 0; i < n_vectors; ++i) values[i] = hn::Add(x[i], hn::Mul(x[i], sum[i]));
}

constexpr std::size_t side_by_side = 2;  // of sines, and as many of cosines: what one waits for the others use

template <bool with_cosines>
HWY_INLINE void sines_of_block(double const* turns, double* sines, double* cosines) {
  Doubles const d;
  std::size_t const lanes = hn::Lanes(d);
  constexpr std::size_t n_vectors = with_cosines ? 2 * side_by_side : side_by_side;
  Vector values[n_vectors];
  for (std::size_t i = 0; i < side_by_side; ++i) {
    values[i] = hn::LoadU(d, turns + i * lanes);
    if constexpr (with_cosines) values[side_by_side + i] = hn::Add(within_half_a_turn(values[i]), hn::Set(d, 0.25));
  }
  sines_of_vectors(values);
  for (std::size_t i = 0; i < side_by_side; ++i) {
    hn::StoreU(values[i], d, sines + i * lanes);
    if constexpr (with_cosines) hn::StoreU(values[side_by_side + i], d, cosines + i * lanes);
  }
}

template <bool with_cosines>
void all_sines(double const* turns, std::size_t n, double* sines, double* cosines) {
  constexpr std::size_t most_lanes = hn::MaxLanes(Doubles());
  std::size_t const block = side_by_side * hn::Lanes(Doubles());
  std::size_t first = 0;
  for (; first + block <= n; first += block)
    sines_of_block<with_cosines>(turns + first, sines + first, with_cosines ? cosines + first : nullptr);
  if (first == n) return;
  double rest[side_by_side * most_lanes] = {}, sine[side_by_side * most_lanes], cosine[side_by_side * most_lanes];
  std::copy_n(turns + first, n - first, rest);
  sines_of_block<with_cosines>(rest, sine, cosine);
  std::copy_n(sine, n - first, sines + first);
  if (with_cosines) std::copy_n(cosine, n - first, cosines + first);
}

void sines_only(double const* turns, std::size_t n, double* sines) { all_sines<false>(turns, n, sines, nullptr); }
void sines_and_cosines(double const* turns, std::size_t n, double* sines, double* cosines) {
  all_sines<true>(turns, n, sines, cosines);
}

}  // namespace torquescope::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope {
namespace {

TORQUESCOPE_EXPORT(sines_only);
TORQUESCOPE_EXPORT(sines_and_cosines);

// by the nearer whole turn, so that a quarter can be added without rounding the angle
double ahead_by_a_quarter(double turns) { return (turns - std::floor(turns + 0.5)) + 0.25; }

}  // namespace

void sines_of_turns(std::span<double const> turns, std::span<double> sines) {
  TORQUESCOPE_EXPECT(turns.size() == sines.size());
  TORQUESCOPE_DISPATCH(sines_only)(turns.data(), turns.size(), sines.data());
}

void sines_cosines_of_turns(std::span<double const> turns, std::span<double> sines, std::span<double> cosines) {
  TORQUESCOPE_EXPECT(turns.size() == sines.size() && turns.size() == cosines.size());
  TORQUESCOPE_DISPATCH(sines_and_cosines)(turns.data(), turns.size(), sines.data(), cosines.data());
}

double sine_of_turns(double turns) {
  double sine = 0.0;
  sines_of_turns({&turns, 1}, {&sine, 1});
  return sine;
}

double cosine_of_turns(double turns) { return sine_of_turns(ahead_by_a_quarter(turns)); }

}  // namespace torquescope
#endif  // HWY_ONCE
