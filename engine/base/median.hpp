#pragma once
// The middle of numbers; of an even count the upper of the two in the middle, which is one of them.
//
// Requires   a number; no NaN
// Threads    pure functions

#include <algorithm>
#include <vector>

#include "engine/base/contract.hpp"

namespace torquescope {

inline constexpr double median_of_normal = 0.6744897501960817;  // of |z|, z standard normal

template <class Number>
Number upper_median(std::vector<Number> values) {
  TORQUESCOPE_EXPECT(!values.empty());
  auto const middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace torquescope
