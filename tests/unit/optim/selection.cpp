#include "engine/fit/optim/selection.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace torquescope {
namespace selection_test {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Selection, AcceptsTies) {
  EXPECT_TRUE(trial_wins(1.0, 1.0));
  EXPECT_TRUE(trial_wins(-2.0, -1.0));
  EXPECT_FALSE(trial_wins(1.0000001, 1.0));
}

TEST(Selection, NonfiniteNeverWinsAndAlwaysLoses) {
  for (double const wrong : {nan, inf, -inf}) {
    EXPECT_FALSE(trial_wins(wrong, 1.0));
    EXPECT_FALSE(trial_wins(wrong, inf));
    EXPECT_FALSE(trial_wins(wrong, nan));
    EXPECT_TRUE(trial_wins(1e300, wrong));
    EXPECT_EQ(ranked_fitness(wrong), inf);
  }
  EXPECT_EQ(count_nonfinite(std::vector{1.0, nan, inf, -inf, -3.0}), 3u);
}

TEST(Selection, IsSlotBySlotAndLeavesTheRestOfATruncatedBatch) {
  Population population(3, 1);
  population.numbers = {10.0, 20.0, 30.0};
  population.fitness = {1.0, 2.0, 3.0};
  std::vector<double> trials{11.0, 21.0};
  std::vector<std::size_t> winners{2, 1};
  select({trials.data(), 2, 1}, std::vector{0.5, 2.5}, population, winners);
  EXPECT_EQ(winners, std::vector<std::size_t>{0});
  EXPECT_EQ(population.numbers, (std::vector{11.0, 20.0, 30.0}));
  EXPECT_EQ(population.fitness, (std::vector{0.5, 2.0, 3.0}));
  EXPECT_EQ(best_index(population.fitness), 0u);
}

}  // namespace selection_test
}  // namespace torquescope
