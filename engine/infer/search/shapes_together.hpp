#pragma once
// Shapes of one effect side by side: the filter takes eight columns in the time of one, and states that remember do not
// wait for themselves.
//
// Together   up to eight shapes, fewer where a thread would be left without
// Threads    spreads the parts over `threads`

#include <algorithm>
#include <cstddef>

#include "engine/base/parallel.hpp"

namespace torquescope {

// work(first, last) for parts of 0 .. n - 1
template <typename Work>
void for_shapes_together(std::size_t n, int threads, Work const& work) {
  constexpr std::size_t most = 8;
  auto const team = static_cast<std::size_t>(std::max(1, threads));
  std::size_t const together = std::clamp<std::size_t>((n + team - 1) / team, 1, most);
  parallel_for((n + together - 1) / together, threads, [&](std::size_t part, int) {
    std::size_t const first = part * together;
    work(first, std::min(n, first + together));
  });
}

}  // namespace torquescope
