// Dry friction that bends and creeps: closed forms, energy, the set-valued law as its limit, lanes by themselves.

#include "engine/simulate/sticking_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/simulate/lane_noise.hpp"
#include "kernels/dispatch.hpp"

using namespace torquescope;

namespace sticking_lanes_test {

constexpr double inertia = 0.04, coulomb = 1.3, step_s = 1e-4;
LaneJoint const light{inertia, 0.0, 0.0, 0.0};

LaneTorques friction_and(double held) {
  LaneTorques torques;
  std::fill_n(torques.held, replicate_lanes, held);
  std::fill_n(torques.forward, replicate_lanes, coulomb);
  std::fill_n(torques.backward, replicate_lanes, -coulomb);
  return torques;
}

LaneSticking controller_of(double creep, double length) {
  LaneSticking controller;
  std::fill_n(controller.creep, replicate_lanes, creep);
  std::fill_n(controller.length, replicate_lanes, length);
  return controller;
}

TEST(StickingLanes, CreepInProportionToWhatPushesThem) {
  LaneState state;
  LaneSticking controller = controller_of(0.02, 0.0);
  advance_sticking_lanes(light, friction_and(0.25 * coulomb), step_s, 10000, controller, state);
  EXPECT_NEAR(state.dq[0], 0.25 * 0.02, 1e-12);
  EXPECT_NEAR(controller.bend[0], 0.25, 1e-9);
}

TEST(StickingLanes, BendLikeASpringAndComeBack) {
  double const length = 1e-3;
  LaneState state;
  LaneSticking controller = controller_of(0.0, length);
  LaneJoint const damped{inertia, 10.0, 0.0, 0.0};
  advance_sticking_lanes(damped, friction_and(0.5 * coulomb), step_s, 20000, controller, state);
  EXPECT_NEAR(state.q[0], 0.5 * length, 1e-6 * length);
  advance_sticking_lanes(damped, friction_and(0.0), step_s, 20000, controller, state);
  EXPECT_NEAR(state.q[0], 0.0, 1e-6 * length);
}

TEST(StickingLanes, OnlyTakeEnergy) {
  // a lane each for controllers from set-valued to long bristles and fast creep
  LaneSticking controller;
  LaneState state;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    controller.creep[lane] = lane % 4 == 0 ? 0.0 : 1e-4 * std::pow(10.0, static_cast<double>(lane % 4));
    controller.length[lane] = lane / 4 == 0 ? 0.0 : 1e-5 * std::pow(10.0, static_cast<double>(lane / 4));
    controller.bend[lane] = lane % 2 == 0 ? 1.0 : -1.0;
    state.dq[lane] = 0.4;
  }
  LaneTorques const torques = friction_and(0.0);
  auto const energy = [&](std::size_t lane) {
    double const stored = 0.5 * coulomb * controller.length[lane] * controller.bend[lane] * controller.bend[lane];
    return 0.5 * inertia * state.dq[lane] * state.dq[lane] + stored;
  };
  double before[replicate_lanes];
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) before[lane] = energy(lane);
  for (int step = 0; step < 3000; ++step) {
    advance_sticking_lanes(light, torques, step_s, 1, controller, state);
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
      ASSERT_LE(energy(lane), before[lane] * (1.0 + 1e-12) + 1e-18) << lane << " " << step;
      before[lane] = energy(lane);
    }
  }
  // stopped by set-valued friction after dq^2 J / 2 F
  EXPECT_NEAR(state.q[0], 0.5 * inertia * 0.16 / coulomb, 0.4 * step_s);
  EXPECT_NEAR(state.dq[0], 0.0, 1e-15);
}

double torque_at(int tick, std::size_t lane) {
  double const phase = 0.35 * static_cast<double>(lane);
  return 2.6 * std::sin(0.02 * tick + phase) + (tick % 400 < 80 ? 0.0 : 0.4 * std::cos(0.11 * tick + phase));
}

LaneJoint const heavy{inertia, 0.2, 0.8, 0.3};

template <class Advance>
LaneState driven(Advance const& advance) {
  LaneState state;
  LaneTorques torques = friction_and(0.0);
  for (int tick = 0; tick < 1000; ++tick) {
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) torques.held[lane] = torque_at(tick, lane);
    advance(torques, state);
  }
  return state;
}

LaneState driven_by(LaneSticking const& start, std::size_t steps_per_tick) {
  LaneSticking controller = start;
  return driven([&](LaneTorques const& torques, LaneState& state) {
    advance_sticking_lanes(heavy, torques, 1e-3 / static_cast<double>(steps_per_tick), steps_per_tick, controller,
                           state);
  });
}

double largest_difference(LaneState const& a, LaneState const& b) {
  double largest = 0.0;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
    largest = std::max(largest, std::abs(a.q[lane] - b.q[lane]));
  return largest;
}

LaneState held_at_once() {
  return driven([&](LaneTorques const& torques, LaneState& state) { advance_lanes(heavy, torques, 1e-5, 100, state); });
}

TEST(StickingLanes, HaveTheSetValuedControllerAsTheirLimit) {
  LaneState const exact = held_at_once();
  double const coarse = largest_difference(driven_by(controller_of(0.0, 0.0), 10), exact);
  double const fine = largest_difference(driven_by(controller_of(0.0, 0.0), 100), exact);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_GT(coarse / fine, 5.0);  // of first order: 10
  double const slow = largest_difference(driven_by(controller_of(1e-4, 0.0), 100), exact);
  double const fast = largest_difference(driven_by(controller_of(1e-2, 0.0), 100), exact);
  EXPECT_LT(slow, 0.05 * fast);
  EXPECT_GT(fast, 1e-4);
}

TEST(StickingLanes, DoNotKnowTheirNeighbours) {
  LaneSticking controller = controller_of(0.01, 1e-3);
  LaneState const alike = driven_by(controller, 10);
  for (std::size_t lane = 1; lane < replicate_lanes; lane += 2)
    controller.creep[lane] = 1e-4 * static_cast<double>(lane);
  LaneState const mixed = driven_by(controller, 10);
  for (std::size_t lane = 0; lane < replicate_lanes; lane += 2) EXPECT_EQ(alike.q[lane], mixed.q[lane]) << lane;
  for (std::size_t lane = 1; lane < replicate_lanes; lane += 2) EXPECT_NE(alike.q[lane], mixed.q[lane]) << lane;
}

TEST(StickingLanes, HaveTheSameBitsOnEveryInstructionSet) {
  LaneSticking const controller = controller_of(0.01, 1e-3);
  auto const best = driven_by(controller, 10);
  for (auto const name : kernels::supported_instruction_sets()) {
    ASSERT_TRUE(kernels::force_instruction_set(name));
    auto const forced = driven_by(controller, 10);
    EXPECT_EQ(std::memcmp(&best, &forced, sizeof(best)), 0) << name;
  }
  kernels::release_instruction_set();
}

TEST(StickingLanes, DrawAllSizesOfCreepAlikeWithinTheRange) {
  StickingRange const range{1e-4, 2e-2, 3e-3};
  constexpr std::uint32_t groups = 100;
  int slow = 0, rigid = 0, n = 0;
  for (std::uint32_t group = 0; group < groups; ++group) {
    LaneSticking controller, again;
    draw_sticking({7, 0, 4}, group, range, -0.1, controller);
    draw_sticking({7, 0, 4}, group, range, -0.1, again);
    EXPECT_EQ(std::memcmp(&controller, &again, sizeof controller), 0);
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane, ++n) {
      EXPECT_GE(controller.creep[lane], range.least_creep);
      EXPECT_LE(controller.creep[lane], range.most_creep);
      EXPECT_GE(controller.length[lane], 0.0);
      EXPECT_LE(controller.length[lane], range.most_length);
      EXPECT_EQ(controller.bend[lane], -1.0);
      if (controller.creep[lane] < std::sqrt(range.least_creep * range.most_creep)) ++slow;
      if (controller.length[lane] == 0.0) ++rigid;
    }
  }
  EXPECT_NEAR(slow, n / 2, 5.0 * std::sqrt(0.25 * n));
  EXPECT_NEAR(rigid, n / 2, 5.0 * std::sqrt(0.25 * n));
}

}  // namespace sticking_lanes_test
