#pragma once
// The chi-squared distribution with whole degrees of freedom.
//
// Source     Abramowitz, Stegun 1964, 26.4.4 and 26.4.5: finite sums
// Threads    free function

#include <cmath>
#include <numbers>

namespace torquescope {

// chance of a value above `statistic`; 1 where nothing is free
inline double chi_squared_tail(double statistic, int degrees_of_freedom) {
  if (degrees_of_freedom < 1 || !(statistic > 0.0)) return 1.0;
  double const half = 0.5 * statistic;
  bool const is_even = degrees_of_freedom % 2 == 0;
  // Q(s + 1, x) = Q(s, x) + x^s exp(-x) / gamma(s + 1), from s = 1 or 1/2
  double order = is_even ? 1.0 : 0.5;
  double tail = is_even ? std::exp(-half) : std::erfc(std::sqrt(half));
  double term = is_even ? half * std::exp(-half) : 2.0 * std::sqrt(half / std::numbers::pi) * std::exp(-half);
  for (; order < 0.5 * degrees_of_freedom - 0.25; order += 1.0) {
    tail += term;
    term *= half / (order + 1.0);
  }
  return tail;
}

}  // namespace torquescope
