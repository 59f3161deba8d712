#include "engine/fit/optim/restart_plan.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace torquescope {
namespace restart_plan_test {

RandomStream stream(std::uint32_t restart) { return {{7, 0, RandomDomain::test}, restart, 0}; }

TEST(RestartPlan, IpopDoublesNineTimes) {
  RestartPlan plan(Restarts::ipop);
  std::size_t expected = 1;
  for (std::uint32_t restart = 0; restart < 12; ++restart) {
    EXPECT_EQ(plan.samples(), expected);
    EXPECT_EQ(plan.width(), 1.0);
    plan.count(100);
    EXPECT_FALSE(plan.is_spent());
    auto random = stream(restart);
    plan.begin_next(random);
    expected = std::min<std::size_t>(2 * expected, 512);
  }
}

TEST(RestartPlan, SameChangesNothing) {
  RestartPlan plan(Restarts::same);
  for (std::uint32_t restart = 0; restart < 5; ++restart) {
    plan.count(100);
    auto random = stream(restart);
    plan.begin_next(random);
    EXPECT_EQ(plan.samples(), 1u);
    EXPECT_EQ(plan.width(), 1.0);
  }
}

// each start goes to the kind that has spent less, and a small one ends with half of the last large one
TEST(RestartPlan, BipopSharesEvaluationsBetweenItsKinds) {
  RestartPlan plan(Restarts::bipop);
  double large = 0.0, small = 0.0, last_large = 0.0;
  std::size_t largest = 1;
  int n_small = 0;
  for (std::uint32_t restart = 0; restart < 60; ++restart) {
    auto random = stream(restart);
    plan.begin_next(random);
    if (restart > 0 && small < large) {
      ++n_small;
      EXPECT_LE(plan.samples(), std::max<std::size_t>(1, largest / 2));
      EXPECT_LE(plan.width(), 1.0);
      EXPECT_GE(plan.width(), 0.01);
      while (!plan.is_spent()) {
        plan.count(10);
        small += 10.0;
      }
      EXPECT_LT(plan.numbers()[4], 0.5 * last_large + 10.0);
    } else {
      largest = std::min<std::size_t>(2 * largest, 512);
      EXPECT_EQ(plan.samples(), largest);
      EXPECT_EQ(plan.width(), 1.0);
      last_large = 1000.0 * static_cast<double>(largest);
      plan.count(static_cast<std::int64_t>(last_large));
      EXPECT_FALSE(plan.is_spent());
      large += last_large;
    }
  }
  EXPECT_GT(n_small, 10);
}

TEST(RestartPlan, GoesOnFromItsNumbers) {
  RestartPlan plan(Restarts::bipop), other(Restarts::bipop);
  for (std::uint32_t restart = 0; restart < 20; ++restart) {
    plan.count(50 + restart);
    auto const numbers = plan.numbers();
    ASSERT_TRUE(RestartPlan::accepts(numbers));
    other.restore(numbers);
    auto one = stream(restart), two = stream(restart);
    plan.begin_next(one);
    other.begin_next(two);
    EXPECT_EQ(plan.numbers(), other.numbers());
  }
  std::vector<double> wrong(RestartPlan::n_numbers, 0.0);
  EXPECT_FALSE(RestartPlan::accepts(wrong));
  wrong.assign(RestartPlan::n_numbers, 1e6);
  EXPECT_FALSE(RestartPlan::accepts(wrong));
}

}  // namespace restart_plan_test
}  // namespace torquescope
