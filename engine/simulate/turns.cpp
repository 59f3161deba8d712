#include "engine/simulate/turns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "engine/base/contract.hpp"
#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simulate/turns.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/fused-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Vector = hn::Vec<Doubles>;

// (sin x - x) / x^3 and (cos x - 1 + x^2 / 2) / x^4 as polynomials of x^2 on [-pi/4, pi/4] (fdlibm k_sin, k_cos)
inline constexpr double of_sine[] = {-1.66666666666666324348e-01, 8.33333333332248946124e-03,
                                     -1.98412698298579493134e-04, 2.75573137070700676789e-06,
                                     -2.50507602534068634195e-08, 1.58969099521155010221e-10};
inline constexpr double of_cosine[] = {4.16666666666666019037e-02, -1.38888888888741095749e-03,
                                       2.48015872894767294178e-05, -2.75573143513906633035e-07,
                                       2.08757232129817482790e-09, -1.13596475577881948265e-11};

// by the nearer whole turn; 0 is added so that -0 becomes 0
HWY_INLINE Vector within_half_a_turn(Vector turns) {
  Doubles const d;
  Vector const rest = hn::Sub(turns, hn::Floor(hn::Add(turns, hn::Set(d, 0.5))));
  return hn::Add(rest, hn::Zero(d));
}

// coefficients[0] + z (coefficients[1] + z (...))
template <std::size_t n>
HWY_INLINE Vector polynomial(Vector z, double const (&coefficients)[n]) {
  Doubles const d;
  Vector value = hn::Set(d, coefficients[n - 1]);
  for (std::size_t k = n - 1; k-- > 0;)
    value = kernels::HWY_NAMESPACE::fused_mul_add(value, z, hn::Set(d, coefficients[k]));
  return value;
}

struct SineCosine {
  Vector sine, cosine;
};

// what a single angle waits for, the next ones use: the loop over an array overlaps them
HWY_INLINE SineCosine sine_cosine_of(Vector turns) {
  using kernels::HWY_NAMESPACE::fused_mul_add;
  Doubles const d;
  hn::RebindToSigned<Doubles> const bits;
  Vector const one = hn::Set(d, 1.0), half = hn::Set(d, 0.5);

  // turns = whole + quarters / 4 + rest without rounding, |rest| <= 1 / 8; the number of quarters in the last bits
  Vector const within = within_half_a_turn(turns);
  Vector const round_to_integer = hn::Set(d, 0x1.8p52);
  Vector const shifted = hn::Add(hn::Mul(within, hn::Set(d, 4.0)), round_to_integer);
  Vector const quarters = hn::Sub(shifted, round_to_integer);
  Vector const rest = hn::Sub(within, hn::Mul(quarters, hn::Set(d, 0.25)));
  Vector const x = hn::Mul(hn::Set(d, 2.0 * std::numbers::pi), rest), square = hn::Mul(x, x);

  Vector const sine = fused_mul_add(hn::Mul(x, square), polynomial(square, of_sine), x);
  // 1 - x^2 / 2 with what its rounding took
  Vector const half_square = hn::Mul(half, square), first = hn::Sub(one, half_square);
  Vector const lost = hn::Sub(hn::Sub(one, first), half_square);
  Vector const cosine = hn::Add(first, fused_mul_add(hn::Mul(square, square), polynomial(square, of_cosine), lost));

  // odd quarters exchange the two, then each has its sign
  auto const quarter = hn::BitCast(bits, shifted), single = hn::Set(bits, std::int64_t{1});
  auto const is_odd = hn::MaskFromVec(hn::BitCast(d, hn::Neg(hn::And(quarter, single))));
  auto const sign = [&](auto count) {
    return hn::BitCast(d, hn::ShiftLeft<62>(hn::And(count, hn::Set(bits, std::int64_t{2}))));
  };
  return {hn::Xor(hn::IfThenElse(is_odd, cosine, sine), sign(quarter)),
          hn::Xor(hn::IfThenElse(is_odd, sine, cosine), sign(hn::Add(quarter, single)))};
}

template <bool with_cosines>
HWY_INLINE void store(SineCosine const& both, double* sines, double* cosines) {
  Doubles const d;
  hn::StoreU(both.sine, d, sines);
  if constexpr (with_cosines) hn::StoreU(both.cosine, d, cosines);
}

template <bool with_cosines>
void all_sines(double const* turns, std::size_t n, double* sines, double* cosines) {
  Doubles const d;
  constexpr std::size_t lanes = hn::MaxLanes(Doubles());
  std::size_t first = 0;
  for (; first + lanes <= n; first += lanes)
    store<with_cosines>(sine_cosine_of(hn::LoadU(d, turns + first)), sines + first,
                        with_cosines ? cosines + first : nullptr);
  if (first == n) return;
  double rest[lanes] = {}, sine[lanes], cosine[lanes];
  std::copy_n(turns + first, n - first, rest);
  store<with_cosines>(sine_cosine_of(hn::LoadU(d, rest)), sine, cosine);
  std::copy_n(sine, n - first, sines + first);
  if (with_cosines) std::copy_n(cosine, n - first, cosines + first);
}

// one vector of times; every array has room for it
HWY_INLINE void add_line_to_vector(SineLine const& line, double const* times, double* q, double* dq, double* ddq) {
  Doubles const d;
  Vector const angle = hn::Mul(hn::LoadU(d, times), hn::Set(d, line.frequency_hz));
  SineCosine const both = sine_cosine_of(hn::Add(angle, hn::Set(d, line.phase_turns)));
  hn::StoreU(hn::Add(hn::LoadU(d, q), hn::Mul(both.sine, hn::Set(d, line.inverse_omega))), d, q);
  hn::StoreU(hn::Add(hn::LoadU(d, dq), both.cosine), d, dq);
  hn::StoreU(hn::Sub(hn::LoadU(d, ddq), hn::Mul(both.sine, hn::Set(d, line.omega))), d, ddq);
}

void add_line(SineLine const& line, double const* times, std::size_t n, double* q, double* dq, double* ddq) {
  constexpr std::size_t lanes = hn::MaxLanes(Doubles());
  std::size_t first = 0;
  for (; first + lanes <= n; first += lanes)
    add_line_to_vector(line, times + first, q + first, dq + first, ddq + first);
  if (first == n) return;
  double padded[4][lanes] = {};
  double* const columns[] = {q + first, dq + first, ddq + first};
  std::copy_n(times + first, n - first, padded[3]);
  for (std::size_t k = 0; k < 3; ++k) std::copy_n(columns[k], n - first, padded[k]);
  add_line_to_vector(line, padded[3], padded[0], padded[1], padded[2]);
  for (std::size_t k = 0; k < 3; ++k) std::copy_n(padded[k], n - first, columns[k]);
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
TORQUESCOPE_EXPORT(add_line);

}  // namespace

void sines_of_turns(std::span<double const> turns, std::span<double> sines) {
  TORQUESCOPE_EXPECT(turns.size() == sines.size());
  TORQUESCOPE_DISPATCH(sines_only)(turns.data(), turns.size(), sines.data());
}

void sines_cosines_of_turns(std::span<double const> turns, std::span<double> sines, std::span<double> cosines) {
  TORQUESCOPE_EXPECT(turns.size() == sines.size() && turns.size() == cosines.size());
  TORQUESCOPE_DISPATCH(sines_and_cosines)(turns.data(), turns.size(), sines.data(), cosines.data());
}

void add_sine_line(SineLine const& line, std::span<double const> times_s, std::span<double> q, std::span<double> dq,
                   std::span<double> ddq) {
  TORQUESCOPE_EXPECT(q.size() == times_s.size() && dq.size() == times_s.size() && ddq.size() == times_s.size());
  TORQUESCOPE_DISPATCH(add_line)(line, times_s.data(), times_s.size(), q.data(), dq.data(), ddq.data());
}

double sine_of_turns(double turns) {
  double sine = 0.0;
  sines_of_turns({&turns, 1}, {&sine, 1});
  return sine;
}

double cosine_of_turns(double turns) {
  double sine = 0.0, cosine = 0.0;
  sines_cosines_of_turns({&turns, 1}, {&sine, 1}, {&cosine, 1});
  return cosine;
}

}  // namespace torquescope
#endif  // HWY_ONCE
