#pragma once
// The order in which every kernel promises to add, written once more, plainly: what the kernels' bits are compared
// with.

#include <array>
#include <cstddef>
#include <vector>

namespace torquescope::kernels {

inline double sum_of_lanes(std::array<double, 8> const& lane) {
  return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

// neighbours in pairs, an odd one out moves up unchanged: the same tree as halving at powers of two
inline double sum_of_blocks(std::vector<double> blocks) {
  while (blocks.size() > 1) {
    std::vector<double> sums;
    for (std::size_t b = 0; b + 1 < blocks.size(); b += 2) sums.push_back(blocks[b] + blocks[b + 1]);
    if (blocks.size() % 2 == 1) sums.push_back(blocks.back());
    blocks = sums;
  }
  return blocks.empty() ? 0.0 : blocks.front();
}

}  // namespace torquescope::kernels
