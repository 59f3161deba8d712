// The equation of motion in vector lanes, against the scalar plant with steps ten times finer.

#include "engine/simulate/replicate_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/simulate/joint_plant.hpp"
#include "kernels/dispatch.hpp"
#include "unit/simulate/plants.hpp"

using namespace torquescope;
using torquescope::test::plant;

namespace replicate_lanes_test {

constexpr double inertia = 0.04, viscous = 0.2, coulomb = 1.3, weight_sin = 0.8, weight_cos = 0.3;
constexpr double tick_s = 1e-3;

LaneJoint const joint{inertia, viscous, weight_sin, weight_cos};

// a torque that makes every lane slide, turn and stick, each at times of its own
double torque_at(int tick, std::size_t lane) {
  double const phase = 0.35 * static_cast<double>(lane);
  return 2.6 * std::sin(0.02 * tick + phase) + (tick % 400 < 80 ? 0.0 : 0.4 * std::cos(0.11 * tick + phase));
}

LaneState lanes_after(int ticks, std::size_t steps_per_tick) {
  LaneState state;
  LaneTorques torques;
  std::fill_n(torques.forward, replicate_lanes, coulomb);
  std::fill_n(torques.backward, replicate_lanes, -coulomb);
  for (int tick = 0; tick < ticks; ++tick) {
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) torques.held[lane] = torque_at(tick, lane);
    advance_lanes(joint, torques, tick_s / static_cast<double>(steps_per_tick), steps_per_tick, state);
  }
  return state;
}

JointState plant_after(int ticks, std::size_t lane, int steps_per_tick) {
  JointPlant const scalar(plant({{"inertia", inertia},
                                 {"viscous", viscous},
                                 {"coulomb", coulomb},
                                 {"gravity_sin", weight_sin},
                                 {"gravity_cos", weight_cos}}));
  JointState state;
  for (int tick = 0; tick < ticks; ++tick)
    for (int step = 0; step < steps_per_tick; ++step)
      state = scalar.advance(state, torque_at(tick, lane), tick_s / steps_per_tick);
  return state;
}

constexpr int n_ticks = 1000;

double largest_error(std::size_t steps_per_tick) {
  static auto const exact = [] {
    std::array<double, replicate_lanes> q{};
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) q[lane] = plant_after(n_ticks, lane, 100).q;
    return q;
  }();
  auto const state = lanes_after(n_ticks, steps_per_tick);
  double largest = 0.0;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
    largest = std::max(largest, std::abs(state.q[lane] - exact[lane]));
  return largest;
}

TEST(ReplicateLanes, FollowThePlantThroughSlidingTurningAndSticking) {
  // 1 s without any controller to pull them together; an encoder step is 1e-5
  EXPECT_LT(largest_error(10), 1e-6);
}

TEST(ReplicateLanes, AreOfSecondOrder) {
  double const coarse = largest_error(4), fine = largest_error(16);
  EXPECT_GT(coarse / fine, 8.0);  // 16 in theory
}

TEST(ReplicateLanes, StandStillWhileFrictionHolds) {
  LaneState state;
  std::fill_n(state.q, replicate_lanes, 0.7);
  LaneTorques torques;
  std::fill_n(torques.forward, replicate_lanes, 1.3);
  std::fill_n(torques.backward, replicate_lanes, -0.4);
  // lane 0 is pushed a little too hard forwards, lane 1 backwards, the others within the range
  torques.held[0] = 1.31;
  torques.held[1] = -0.41;
  torques.held[2] = 1.29;
  torques.held[3] = -0.39;
  advance_lanes(LaneJoint{inertia, viscous, 0.0, 0.0}, torques, 1e-4, 100, state);
  EXPECT_GT(state.dq[0], 0.0);
  EXPECT_LT(state.dq[1], 0.0);
  for (std::size_t lane = 2; lane < replicate_lanes; ++lane) {
    EXPECT_EQ(state.q[lane], 0.7) << lane;
    EXPECT_EQ(state.dq[lane], 0.0) << lane;
    EXPECT_EQ(state.ddq[lane], 0.0) << lane;
  }
}

TEST(ReplicateLanes, CarryTheInertiaThatIsAddedToThem) {
  // two lanes alike but for a little inertia that one of them is given on top
  double const added = 0.25 * inertia;
  LaneTorques torques;
  std::fill_n(torques.held, replicate_lanes, 2.0);
  std::fill_n(torques.forward, replicate_lanes, coulomb);
  std::fill_n(torques.backward, replicate_lanes, -coulomb);
  LaneState plain, heavy, both;
  advance_lanes(joint, torques, 1e-4, 500, plain);
  advance_lanes(LaneJoint{inertia + added, viscous, weight_sin, weight_cos}, torques, 1e-4, 500, heavy);
  torques.added_inertia[1] = added;
  advance_lanes(joint, torques, 1e-4, 500, both);
  EXPECT_GT(plain.q[0], heavy.q[0]);
  EXPECT_EQ(both.q[0], plain.q[0]);
  EXPECT_EQ(both.q[1], heavy.q[1]);
  EXPECT_EQ(both.dq[1], heavy.dq[1]);
  EXPECT_EQ(both.ddq[1], heavy.ddq[1]);
}

TEST(ReplicateLanes, HaveTheSameBitsOnEveryInstructionSet) {
  auto const best = lanes_after(500, 10);
  for (auto const name : kernels::supported_instruction_sets()) {
    ASSERT_TRUE(kernels::force_instruction_set(name));
    auto const forced = lanes_after(500, 10);
    EXPECT_EQ(std::memcmp(&best, &forced, sizeof(best)), 0) << name;
  }
  kernels::release_instruction_set();
}

}  // namespace replicate_lanes_test
