#include "engine/fit/statistics/student_t.hpp"

#include <cmath>
#include <numbers>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

double expansion(double z, double n) {
  double const z2 = z * z;
  double const first = z * (z2 + 1.0) / 4.0;
  double const second = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  double const third = z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  return z + first / n + second / (n * n) + third / (n * n * n);
}

// chance of a value between 0 and t. With t = sqrt(n) tan(a) the density becomes cos(a)^(n - 1): Simpson's rule
double chance_up_to(double t, double n) {
  constexpr int intervals = 400;
  double const end = std::atan(t / std::sqrt(n)), step = end / intervals;
  double sum = 0.0;
  for (int i = 0; i <= intervals; ++i) {
    double const weight = i == 0 || i == intervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::pow(std::cos(step * i), n - 1.0);
  }
  double const scale = std::tgamma((n + 1.0) / 2.0) / (std::tgamma(n / 2.0) * std::sqrt(std::numbers::pi));
  return scale * sum * step / 3.0;
}

double solved(double z, double n) {
  double const wanted = 0.5 * std::erf(std::abs(z) / std::numbers::sqrt2);
  double low = 0.0, high = 1.0;
  while (chance_up_to(high, n) < wanted && high < 1e6) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    double const middle = 0.5 * (low + high);
    (chance_up_to(middle, n) < wanted ? low : high) = middle;
  }
  return std::copysign(high, z);
}

}  // namespace

double student_t_quantile(double z, double degrees_of_freedom) {
  TORQUESCOPE_EXPECT(degrees_of_freedom >= 1.0);
  constexpr double expansion_holds = 4.0;
  return degrees_of_freedom < expansion_holds ? solved(z, degrees_of_freedom) : expansion(z, degrees_of_freedom);
}

}  // namespace torquescope
