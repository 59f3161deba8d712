// Steps along the axes end at the lowest point of a bowl, inside the bounds and the budget.

#include "engine/fit/optim/pattern_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace torquescope {
namespace pattern_search_test {

TEST(PatternSearch, EndsInTheBowl) {
  auto const bowl = [](std::vector<double> const& at) {
    double const x = at[0] - 0.31, y = at[1] - 0.74;
    return x * x + 3.0 * y * y + x * y;
  };
  LowestPoint const lowest = pattern_search({{0.5, 0.5}, bowl({0.5, 0.5})}, {0.2, 0.2}, 400, bowl);
  EXPECT_NEAR(lowest.at[0], 0.31, 2e-3);
  EXPECT_NEAR(lowest.at[1], 0.74, 2e-3);
  EXPECT_EQ(lowest.cost, bowl(lowest.at));
}

TEST(PatternSearch, StaysWithinBoundsAndLeavesNumbersWithoutAStep) {
  auto const slope = [](std::vector<double> const& at) {
    EXPECT_GE(*std::min_element(at.begin(), at.end()), 0.0);
    EXPECT_LE(*std::max_element(at.begin(), at.end()), 1.0);
    return -at[0] - at[1];
  };
  LowestPoint const lowest = pattern_search({{0.4, 0.6}, slope({0.4, 0.6})}, {0.3, 0.0}, 100, slope);
  EXPECT_EQ(lowest.at[0], 1.0);
  EXPECT_EQ(lowest.at[1], 0.6);
}

TEST(PatternSearch, StopsAtItsBudget) {
  int calls = 0;
  auto const counted = [&](std::vector<double> const& at) {
    ++calls;
    return at[0];
  };
  pattern_search({{1.0}, 1.0}, {1e-3}, 5, counted);
  EXPECT_LE(calls, 6);
}

}  // namespace pattern_search_test
}  // namespace torquescope
