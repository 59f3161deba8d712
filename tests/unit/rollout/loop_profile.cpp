// A drive's profile generator: the goal stays within its speed and its acceleration, and arrives where it was sent.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/simulate/rollout/loop_lanes.hpp"

using namespace torquescope;

namespace loop_profile_test {

constexpr double tick_s = 1e-3, infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12;

struct Limits {
  double speed = infinite, acceleration = infinite;
};

// the goal of lane 0 at every tick, of lanes whose profiles differ
std::vector<double> led(std::vector<double> const& wanted, Limits const& limits, double from = 0.0) {
  LaneLoops loops(tick_s, 1);
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    LoopNumbers numbers;
    double const times = 1.0 + static_cast<double>(lane);
    numbers.goal_speed = limits.speed * times;
    numbers.goal_acceleration = limits.acceleration * times;
    loops.set(lane, numbers);
  }
  LaneState joint;
  LaneLoopState loop;
  double goal[replicate_lanes], speed[replicate_lanes] = {}, held[replicate_lanes], logged[replicate_lanes];
  std::fill_n(goal, replicate_lanes, from);
  loop.start(loops, joint, goal, 0.0);
  std::vector<double> goals{from};
  for (double const one : wanted) {
    std::fill_n(goal, replicate_lanes, one);
    answer_tick(loops, {goal}, 0, joint.q, speed, loop, held, logged);
    goals.push_back(loop.goal[0]);
  }
  return goals;
}

void expect_within(std::vector<double> const& goals, Limits const& limits) {
  double before = 0.0;
  for (std::size_t k = 1; k < goals.size(); ++k) {
    double const step = goals[k] - goals[k - 1];
    EXPECT_LE(std::abs(step), limits.speed * tick_s + rounding) << k;
    EXPECT_LE(std::abs(step - before), limits.acceleration * tick_s * tick_s + rounding) << k;
    before = step;
  }
}

TEST(LoopProfile, OfAStepIsATrapezoidThatArrivesInItsTime) {
  struct {
    Limits limits;
    double way;
  } const cases[] = {{{0.5, 4.0}, 0.3},       {{0.5, 4.0}, -0.3},      {{0.5, 3.7}, 0.01},
                     {{infinite, 6.1}, 0.37}, {{0.7, infinite}, -0.2}, {{0.333, 2.71}, 0.12345}};
  for (auto const& [limits, way] : cases) {
    auto const goals = led(std::vector<double>(2000, way), limits);
    expect_within(goals, limits);
    // seconds of the quickest motion from rest to rest
    double const size = std::abs(way), peak = std::min(limits.speed, std::sqrt(size * limits.acceleration));
    double const speeding_s = std::isfinite(limits.acceleration) ? peak / limits.acceleration : 0.0;
    double const quickest_s = size / peak + speeding_s;
    std::size_t arrives = 0;
    double beyond = 0.0;
    for (std::size_t k = 0; k < goals.size(); ++k) {
      double const done = goals[k] * (way > 0.0 ? 1.0 : -1.0);
      beyond = std::max(beyond, done - size);
      if (std::abs(done - size) > 1e-9) arrives = k + 1;
    }
    EXPECT_EQ(goals.back(), way);
    EXPECT_NEAR(static_cast<double>(arrives) * tick_s, quickest_s, 5.0 * tick_s) << way;
    // at the last tick before it arrives a speed is no multiple of what a tick can change
    double const change = std::isfinite(limits.acceleration) ? limits.acceleration * tick_s * tick_s : 0.0;
    EXPECT_LE(beyond, 0.125 * change + rounding) << way;
  }
}

TEST(LoopProfile, FollowsAGoalThatMoves) {
  std::vector<double> wanted;
  for (int k = 0; k < 4000; ++k) wanted.push_back(k < 2500 ? 0.4 * std::sin(0.004 * k) : 0.1);
  Limits const limits{0.9, 9.0};
  auto const goals = led(wanted, limits);
  expect_within(goals, limits);
  EXPECT_NEAR(goals.back(), 0.1, rounding);
  // turned round on its way, it brakes first
  std::vector<double> there_and_back(300, 1.0);
  there_and_back.resize(2000, -1.0);
  auto const turned = led(there_and_back, limits);
  expect_within(turned, limits);
  EXPECT_NEAR(turned.back(), -1.0, rounding);
}

TEST(LoopProfile, OfAGoalWithinItsLimitsIsTheGoal) {
  std::vector<double> wanted;
  for (int k = 0; k < 1000; ++k) wanted.push_back(0.2 * (1.0 - std::cos(0.005 * k)));
  auto const goals = led(wanted, {2.0, infinite});
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_EQ(goals[k + 1], wanted[k]);
}

}  // namespace loop_profile_test
