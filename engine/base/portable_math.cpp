#include "engine/base/portable_math.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace torquescope {

namespace {

// ln 2 in two parts: the high one has 33 bits, so that k * high is exact for |k| < 2^20
constexpr double ln2_high = 0x1.62e42feep-1;
constexpr double ln2_low = 0x1.a39ef35793c76p-33;

double power_of_two(int exponent) { return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52); }

}  // namespace

double portable_exp(double x) {
  if (std::isnan(x)) return x;
  if (x > 709.782712893384) return std::numeric_limits<double>::infinity();
  if (x < -745.2) return 0.0;
  // x = k ln 2 + r, |r| <= ln 2 / 2
  double const k = std::floor(x * 1.4426950408889634 + 0.5);
  double const r = (x - k * ln2_high) - k * ln2_low;
  // Taylor to r^13 / 13!: below half an ULP of the remainder on this range
  double sum = 0.0;
  for (int n = 13; n >= 2; --n) sum = (sum + 1.0) * (r / n);
  // exp(r) = 1 + r (1 + r/2 (1 + ...)): the 1 is added last
  double const series = 1.0 + (r + r * sum);
  int const exponent = static_cast<int>(k);
  if (exponent < -1000) return series * power_of_two(-1000) * power_of_two(exponent + 1000);
  if (exponent > 1000) return series * power_of_two(1000) * power_of_two(exponent - 1000);
  return series * power_of_two(exponent);
}

double portable_log(double x) {
  // x = 2^k m, sqrt(1/2) <= m < sqrt(2)
  auto const bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++exponent;
  }
  // log m = 2 atanh(s), s = (m-1)/(m+1), |s| < 0.172
  double const f = m - 1.0;
  double const s = f / (2.0 + f);
  double const z = s * s;
  double series = 0.0;
  for (int n = 23; n >= 3; n -= 2) series = z * (series + 1.0 / n);
  double const k = static_cast<double>(exponent);
  // log(1+f) = f - s (f - 2 series): keeps f exact for m near 1
  double const correction = s * (f - 2.0 * series);
  return k * ln2_high + (f - (correction - k * ln2_low));
}

namespace {

double polynomial(double x, double const (&coefficients)[8]) {
  double value = coefficients[7];
  for (int i = 6; i >= 0; --i) value = value * x + coefficients[i];
  return value;
}

// AS 241: the central region
double central_quantile(double q) {
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
  double const r = 0.180625 - q * q;
  return q * polynomial(r, a) / polynomial(r, b);
}

constexpr double central = 0.425;

}  // namespace

double normal_quantile(double probability) {
  double const q = probability - 0.5;
  if (std::fabs(q) <= central) return central_quantile(q);
  // two tails
  static constexpr double c[8] = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                                  3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                                  2.27238449892691845833e-2, 7.74545014278341407640e-4};
  static constexpr double d[8] = {1.0,
                                  2.05319162663775882187e0,
                                  1.67638483018380384940e0,
                                  6.89767334985100004550e-1,
                                  1.48103976427480074590e-1,
                                  1.51986665636164571966e-2,
                                  5.47593808499534494600e-4,
                                  1.05075007164441684324e-9};
  static constexpr double e[8] = {6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                                  2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                  2.71155556874348757815e-5, 2.01033439929228813265e-7};
  static constexpr double f[8] = {1.0,
                                  5.99832206555887937690e-1,
                                  1.36929880922735805310e-1,
                                  1.48753612908506148525e-2,
                                  7.86869131145613259100e-4,
                                  1.84631831751005468180e-5,
                                  1.42151175831644588870e-7,
                                  2.04426310338993978564e-15};
  double const tail = q < 0.0 ? probability : 1.0 - probability;
  double const r = std::sqrt(-portable_log(tail));
  double const value =
      r <= 5.0 ? polynomial(r - 1.6, c) / polynomial(r - 1.6, d) : polynomial(r - 5.0, e) / polynomial(r - 5.0, f);
  return q < 0.0 ? -value : value;
}

}  // namespace torquescope
