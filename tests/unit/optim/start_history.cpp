#include "engine/fit/optim/start_history.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace torquescope {
namespace start_history_test {

constexpr double inf = std::numeric_limits<double>::infinity();
// R = 2, NP = 6: 10 + 10 generations for a flat one, 120 + 10 for stagnation
constexpr int flat_span = 20, least_span = 130;

using Fitness = std::array<double, 6>;

// the generation after which it is stuck, at most `most`
template <class MakeFitness>
int stuck_after(MakeFitness const& fitness, int most) {
  StartHistory history(2, 6);
  for (int g = 1; g <= most; ++g) {
    if (history.is_stuck_after(fitness(g))) return g;
  }
  return most + 1;
}

TEST(StartHistory, EqualFitnessIsFlat) {
  EXPECT_EQ(stuck_after([](int) { return Fitness{3, 3, 3, 3, 3, 3}; }, 100), flat_span);
  EXPECT_EQ(stuck_after([](int) { return Fitness{0, 0, 0, 0, 0, 0}; }, 100), flat_span);
  // a failed candidate says nothing of the others
  EXPECT_EQ(stuck_after([](int) { return Fitness{3, 3, 3, 3, inf, inf}; }, 100), flat_span);
}

TEST(StartHistory, ARangeInTheLastGenerationIsNotFlat) {
  EXPECT_GT(stuck_after([](int) { return Fitness{3, 3, 3, 3, 3, 4}; }, flat_span + 5), flat_span + 5);
}

TEST(StartHistory, FlatIsRelativeToTheUnitOfFitness) {
  for (double const unit : {1e-30, 1.0, 1e30}) {
    auto const near_one = [&](double spread) {
      return [=](int g) {
        double const f = unit * (1.0 + spread / g);
        return Fitness{f, f, f, f, f, f};
      };
    };
    EXPECT_EQ(stuck_after(near_one(1e-13), 100), flat_span) << unit;
    EXPECT_GT(stuck_after(near_one(1e-8), 100), 100) << unit;
    // a minimum at 0 is approached without end
    auto const to_zero = [&](int g) {
      double const f = unit * std::exp2(-g);
      return Fitness{f, f, f, f, f, 2 * f};
    };
    EXPECT_GT(stuck_after(to_zero, 700), 700) << unit;
  }
}

TEST(StartHistory, NoProgressStagnates) {
  auto const noisy = [](int g) {
    double const f = 1.0 + 0.1 * (g % 3);
    return Fitness{f, f + 1, f + 1, f + 1, f + 1, f + 2};
  };
  EXPECT_EQ(stuck_after(noisy, 1000), least_span);
  auto const falling = [&](int g) {
    auto f = noisy(g);
    for (double& v : f) v -= 0.01 * g;
    return f;
  };
  EXPECT_GT(stuck_after(falling, 1000), 1000);
  // nothing finite at all
  EXPECT_EQ(stuck_after([](int) { return Fitness{inf, inf, inf, inf, inf, inf}; }, 1000), least_span);
}

TEST(StartHistory, GoesOnFromItsNumbersAndForgetsWhatNobodyLooksAt) {
  StartHistory history(2, 6);
  auto const fitness = [](int g) { return Fitness{1.0 / g, 2, 3, 4.0 + 1.0 / g, 5, 6}; };
  for (int g = 1; g <= 1000; ++g) {
    ASSERT_FALSE(history.is_stuck_after(fitness(g)));
    auto const numbers = history.numbers();
    StartHistory other(2, 6);
    ASSERT_TRUE(other.accepts(numbers));
    other.restore(numbers);
    EXPECT_EQ(other.numbers(), numbers);
  }
  EXPECT_EQ(history.numbers().size(), 1u + 2u * 200u);
  auto cut = history.numbers();
  cut.pop_back();
  EXPECT_FALSE(history.accepts(cut));
  EXPECT_FALSE(history.accepts({}));
}

}  // namespace start_history_test
}  // namespace torquescope
