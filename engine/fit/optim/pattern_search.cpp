#include "engine/fit/optim/pattern_search.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace torquescope {
namespace {

constexpr double finest_step = 1e-3, shrinking = 0.4;

double widest_of(std::vector<double> const& steps) {
  return steps.empty() ? 0.0 : *std::max_element(steps.begin(), steps.end());
}

}  // namespace

LowestPoint pattern_search(LowestPoint start, std::vector<double> steps, int most_evaluations,
                           std::function<double(std::vector<double> const&)> const& cost) {
  LowestPoint best = std::move(start);
  int evaluations = 0;
  // whether one of the two neighbours on that axis is lower: the first that is, is taken
  auto const goes_down = [&](std::size_t k) {
    for (double const side : {1.0, -1.0}) {
      std::vector<double> tried = best.at;
      tried[k] = std::clamp(tried[k] + side * steps[k], 0.0, 1.0);
      if (steps[k] == 0.0 || tried[k] == best.at[k]) continue;
      ++evaluations;
      double const here = cost(tried);
      if (!(here < best.cost)) continue;
      best = {std::move(tried), here};
      return true;
    }
    return false;
  };
  double const smallest = finest_step * widest_of(steps);
  while (widest_of(steps) > smallest && evaluations < most_evaluations) {
    bool moved = false;
    for (std::size_t k = 0; k < steps.size(); ++k) moved = goes_down(k) || moved;
    if (!moved)
      for (double& step : steps) step *= shrinking;
  }
  return best;
}

}  // namespace torquescope
