#pragma once
// Logical lanes of every sum over samples: the same on every instruction set, whatever its vectors hold.

#include <cstddef>

namespace torquescope::kernels {

inline constexpr std::size_t n_lanes = 8;

// the one order in which lanes are added
inline double sum_lanes(double const* lane) {
  return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

}  // namespace torquescope::kernels
