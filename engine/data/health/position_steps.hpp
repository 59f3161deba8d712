#pragma once
// Steps of a position that its neighbours do not explain: wrong rows, jumps, wraps.
//
// Steps      d_i = x_i - x_(i-1) between rows that hold a number, bends s_i = x_(i+1) - 2 x_i + x_(i-1)
// Threads    free functions

#include <cstddef>
#include <vector>

namespace torquescope {

// how fast a signal bends as a rule, and how coarse it is: what a wrong row or a jump must stand out from
struct Roughness {
  double bend = 0.0;          // 98th percentile of |s_i|
  double encoder_step = 0.0;  // 0: none seen
};
Roughness roughness_of(std::vector<double> const& values);

// at most five rows away from where the rows around them lead, and back again
struct Excursion {
  std::size_t first = 0, count = 0;  // rows
  double size = 0.0;
};
std::vector<Excursion> excursions_of(std::vector<double> const& values, Roughness const& roughness);

// from one row to the next to a place from where the motion goes on
struct Jump {
  std::size_t row = 0;
  double size = 0.0;      // with its sign
  double expected = 0.0;  // the step that the rows around it would have made
};
// time_s: of each row, or empty; while rows are missing the joint goes on
std::vector<Jump> jumps_of(std::vector<double> const& values, std::vector<double> const& time_s,
                           Roughness const& roughness);

}  // namespace torquescope
