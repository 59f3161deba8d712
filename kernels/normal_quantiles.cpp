#include "kernels/normal_quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/normal_quantiles.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace {

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using Bits = hn::RebindToSigned<D>;
inline constexpr D d;
inline constexpr Bits bits;
inline constexpr std::size_t lanes = hn::MaxLanes(d);

inline constexpr std::size_t together = 256;  // uniforms whose tails are gathered
inline constexpr double central = 0.425;

HWY_INLINE V set(double value) { return hn::Set(d, value); }

HWY_INLINE V polynomial(V x, double const (&coefficients)[8]) {
  V value = set(coefficients[7]);
  for (std::size_t i = 7; i-- > 0;) value = hn::Add(hn::Mul(value, x), set(coefficients[i]));
  return value;
}

HWY_INLINE V central_quantile(V q) {
  static constexpr double a[8] = {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
                                  1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
                                  3.3430575583588128105e4, 2.5090809287301226727e3};
  static constexpr double b[8] = {1.0,
                                  4.2313330701600911252e1,
                                  6.8718700749205790830e2,
                                  5.3941960214247511077e3,
                                  2.1213794301586595867e4,
                                  3.9307895800092710610e4,
                                  2.8729085735721942674e4,
                                  5.2264952788528545610e3};
  V const r = hn::Sub(set(0.180625), hn::Mul(q, q));
  return hn::Div(hn::Mul(q, polynomial(r, a)), polynomial(r, b));
}

// portable_log
HWY_INLINE V logarithm(V x) {
  auto const word = hn::BitCast(bits, x);
  auto const one = hn::Set(bits, std::int64_t{0x3ff0000000000000});
  auto exponent = hn::Sub(hn::ShiftRight<52>(word), hn::Set(bits, 1023));
  V m = hn::BitCast(d, hn::Or(hn::And(word, hn::Set(bits, std::int64_t{0x000fffffffffffff})), one));
  auto const is_large = hn::Gt(m, set(1.4142135623730951));
  m = hn::IfThenElse(is_large, hn::Mul(m, set(0.5)), m);
  V const k = hn::Add(hn::ConvertTo(d, exponent), hn::IfThenElseZero(is_large, set(1.0)));

  V const f = hn::Sub(m, set(1.0));
  V const s = hn::Div(f, hn::Add(set(2.0), f));
  V const z = hn::Mul(s, s);
  V series = hn::Zero(d);
  for (int n = 23; n >= 3; n -= 2) series = hn::Mul(z, hn::Add(series, set(1.0 / n)));
  V const correction = hn::Mul(s, hn::Sub(f, hn::Mul(set(2.0), series)));
  V const low = hn::Sub(correction, hn::Mul(k, set(0x1.a39ef35793c76p-33)));
  return hn::Add(hn::Mul(k, set(0x1.62e42feep-1)), hn::Sub(f, low));
}

HWY_INLINE V tail_quantile(V probability) {
  static constexpr double c[8] = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                                  3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                                  2.27238449892691845833e-2, 7.74545014278341407640e-4};
  static constexpr double e[8] = {1.0,
                                  2.05319162663775882187e0,
                                  1.67638483018380384940e0,
                                  6.89767334985100004550e-1,
                                  1.48103976427480074590e-1,
                                  1.51986665636164571966e-2,
                                  5.47593808499534494600e-4,
                                  1.05075007164441684324e-9};
  static constexpr double far_c[8] = {6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                                      2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                      2.71155556874348757815e-5, 2.01033439929228813265e-7};
  static constexpr double far_e[8] = {1.0,
                                      5.99832206555887937690e-1,
                                      1.36929880922735805310e-1,
                                      1.48753612908506148525e-2,
                                      7.86869131145613259100e-4,
                                      1.84631831751005468180e-5,
                                      1.42151175831644588870e-7,
                                      2.04426310338993978564e-15};
  auto const is_low = hn::Lt(hn::Sub(probability, set(0.5)), hn::Zero(d));
  V const tail = hn::IfThenElse(is_low, probability, hn::Sub(set(1.0), probability));
  V const r = hn::Sqrt(hn::Neg(logarithm(tail)));
  V const near = hn::Sub(r, set(1.6)), far = hn::Sub(r, set(5.0));
  V value = hn::Div(polynomial(near, c), polynomial(near, e));
  auto const is_far = hn::Gt(r, set(5.0));
  if (HWY_UNLIKELY(!hn::AllFalse(d, is_far)))
    value = hn::IfThenElse(is_far, hn::Div(polynomial(far, far_c), polynomial(far, far_e)), value);
  return hn::IfThenElse(is_low, hn::Neg(value), value);
}

// n <= together; room for a whole vector behind the last of each array
struct Gathered {
  double probability[together + lanes], quantile[together + lanes];
  std::uint32_t place[together + 1];
};

template <class Function>
HWY_INLINE void whole_vectors(std::size_t n, double const* in, double* out, Function const& function) {
  for (std::size_t i = 0; i < n; i += lanes) hn::StoreU(function(hn::LoadU(d, in + i)), d, out + i);
}

// one in seven lies in a tail: all are taken for central ones, then the tails by themselves
void quantiles_of(double const* probabilities, std::size_t n, double* quantiles) {
  HWY_ALIGN Gathered tails;
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    tails.place[count] = static_cast<std::uint32_t>(i);
    tails.probability[count] = probabilities[i];
    count += std::fabs(probabilities[i] - 0.5) <= central ? 0 : 1;
  }
  std::fill_n(tails.probability + count, lanes, 0.5);
  whole_vectors(count, tails.probability, tails.quantile, [](V p) HWY_ATTR { return tail_quantile(p); });
  auto const of_center = [](V p) HWY_ATTR { return central_quantile(hn::Sub(p, set(0.5))); };
  std::size_t const whole = n - n % lanes;
  whole_vectors(whole, probabilities, quantiles, of_center);
  if (whole < n) {
    double rest[lanes] = {};
    std::copy(probabilities + whole, probabilities + n, rest);
    whole_vectors(lanes, rest, rest, of_center);
    std::copy(rest, rest + (n - whole), quantiles + whole);
  }
  for (std::size_t k = 0; k < count; ++k) quantiles[tails.place[k]] = tails.quantile[k];
}

}  // namespace

void all_quantiles(double const* probabilities, std::size_t n, double* quantiles) {
  for (std::size_t done = 0; done < n; done += together)
    quantiles_of(probabilities + done, std::min(together, n - done), quantiles + done);
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {
TORQUESCOPE_EXPORT(all_quantiles);
}  // namespace

void normal_quantiles(double const* probabilities, std::size_t n, double* quantiles) {
  TORQUESCOPE_DISPATCH(all_quantiles)(probabilities, n, quantiles);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
