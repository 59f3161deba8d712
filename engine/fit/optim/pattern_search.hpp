#pragma once
// The lowest point near a start, by steps along the axes: for a handful of numbers and a cost without a gradient.
//
// Scale      every number is in [0, 1]; one whose first step is 0 stays
// Steps      all shrink to 0.4 where none goes down, until the largest is a thousandth of the first
// Threads    free function; cost is called from the caller's thread
// Source     Hooke, Jeeves 1961, doi:10.1145/321062.321069 (without pattern moves)

#include <functional>
#include <vector>

namespace torquescope {

struct LowestPoint {
  std::vector<double> at{};
  double cost = 0.0;
};

// start: with its cost; steps: one each; most_evaluations: of cost, looked at after each round of two an axis
LowestPoint pattern_search(LowestPoint start, std::vector<double> steps, int most_evaluations,
                           std::function<double(std::vector<double> const&)> const& cost);

}  // namespace torquescope
