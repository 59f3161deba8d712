// A trial is the same to the last bit whatever stands beside it, on any number of threads and any instruction set.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/simulate/rollout/rollout_residuals.hpp"
#include "kernels/dispatch.hpp"
#include "unit/rollout/servos.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace lane_bits_test {

constexpr int samples = 700;

PlainInputs inputs() {
  PlainInputs made;
  made.reference = waves(samples, made.rate_hz);
  for (int k = 0; k < samples; ++k) {
    made.added.push_back(0.2 * std::sin(0.05 * k));
    made.enabled.push_back(k % 350 < 300 ? 1.0 : 0.0);
  }
  return made;
}

// each has what the others lack
std::vector<RolloutTrial> trials() {
  PlainJoint light, heavy, dry;
  heavy.gravity_sin = 0.8;
  dry.forward = 0.3;
  dry.backward = -0.5;
  PlainController p{"p", 3.0}, pi{"pi", 3.0, 2.0}, pd{"pd", 18.0, 0.0, 1.0}, cascade{"p_pi", 12.0, 6.0, 0.0, 1.2};
  PlainController limited = pd, late = pd, lagging = pd, fed = pd, voltage = pd;
  limited.limit = 0.6;
  late.torque_delay_s = 0.0033;
  late.command_delay_s = 0.0051;
  lagging.torque_lag_s = 0.004;
  lagging.log_lag_s = 0.005;
  lagging.speed_lag_s = 0.006;
  fed.feed_speed = 0.9;
  fed.feed_acceleration = 0.05;
  voltage.back_emf = 0.3;
  std::vector<RolloutTrial> made;
  for (auto const& joint : {light, heavy, dry})
    for (auto const& controller : {p, pi, pd, cascade, limited, late, lagging, fed, voltage})
      made.push_back(trial_of(joint, controller));
  made.push_back(trial_of(dry, pd));
  made.back().loop.goal_speed = 0.5;
  made.back().loop.goal_acceleration = 4.0;
  made.push_back(trial_of(light, pd));
  made.back().position_step = 1e-3;
  made.back().velocity_step = -0.1;
  std::vector<PlainServo> servos(9);
  servos[0].load = 0.2;
  servos[1].load_square = 0.1;
  servos[2].stribeck = 0.15;
  servos[3].load_stribeck = 0.2;
  servos[4].dead_band = 0.02;
  servos[5].punch = 1.0;
  servos[6].encoder_step = 1.5e-3;
  servos[7].command_delay_s = 0.0233;
  servos[8].limit = 5.0;
  servos[8].load = servos[8].stribeck = 0.1;
  for (auto const& servo : servos) made.push_back(trial_of(servo));
  made.back().arm_mass = 0.1;
  made.back().motor_gain_per_kelvin = -0.004;
  made.back().encoder_step = 2e-3;
  made.back().encoder_phase = 5e-4;
  return made;
}

// what a track knows stands beside every trial
RolloutTrack known_track() {
  RolloutTrack track = track_of(inputs(), {0.01, 0.2, 0.3});
  track.known = {0.7, 0.01, 0.9, 6.0, 0.15, 40.0};
  return track;
}

void expect_no_neighbours(RolloutTrack const& track) {
  auto const all = trials();
  RolloutStructure const structure = structure_of(PlainController{});
  // sixteen at a time, at places of their own
  for (std::size_t first = 0; first < all.size(); first += 5) {
    std::vector<RolloutTrial> together;
    for (std::size_t i = 0; i < replicate_lanes; ++i) together.push_back(all[(first + 7 * i) % all.size()]);
    Rolled const beside = rolled(track, structure, together);
    for (std::size_t i = 0; i < replicate_lanes; ++i) {
      auto const lane = static_cast<Eigen::Index>(i);
      Rolled const alone = rolled(track, structure, {together[i]});
      std::size_t const which = (first + 7 * i) % all.size();
      EXPECT_TRUE(same_bits(beside.position.col(lane), alone.position)) << which;
      EXPECT_TRUE(same_bits(beside.velocity.col(lane), alone.velocity)) << which;
      EXPECT_TRUE(same_bits(beside.torque.col(lane), alone.torque)) << which;
    }
  }
}

TEST(LaneBits, DoNotDependOnTheNeighbours) {
  expect_no_neighbours(track_of(inputs(), {0.01, 0.2, 0.3}));
  expect_no_neighbours(known_track());
}

// tick by tick as well, where a wave of no size is asked
TEST(LaneBits, DoNotDependOnTheNeighboursTickByTick) {
  RolloutTrack const track = known_track();
  RolloutStructure structure = structure_of({});
  structure.effects = {find_effect("cogging")};
  auto all = trials();
  all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(replicate_lanes));
  for (auto& trial : all) trial.effects = {{0.0, 0.0, 7.0}};
  Rolled const beside = rolled(track, structure, all);
  for (std::size_t i = 0; i < replicate_lanes; ++i) {
    Rolled const alone = rolled(track, structure, {all[i]});
    EXPECT_TRUE(same_bits(beside.position.col(static_cast<Eigen::Index>(i)), alone.position)) << i;
    EXPECT_TRUE(same_bits(beside.torque.col(static_cast<Eigen::Index>(i)), alone.torque)) << i;
  }
}

TEST(LaneBits, OfLostAndImpossibleNeighboursTouchNobody) {
  RolloutTrack const track = track_of(inputs(), {0.01, 0.2, 0.3});
  auto const all = trials();
  RolloutTrial runs_away = all[2], impossible = all[2];
  runs_away.loop.kp = -500.0;
  impossible.joint.inertia = -1.0;
  impossible.is_possible = false;
  Rolled const mixed = rolled(track, structure_of({}), {impossible, all[2], runs_away, all[10]});
  EXPECT_TRUE(mixed.position.col(0).array().isNaN().all());
  EXPECT_TRUE(mixed.torque.col(0).array().isNaN().all());
  EXPECT_TRUE(std::isnan(mixed.position(samples - 1, 2)));
  EXPECT_TRUE(same_bits(mixed.position.col(1), rolled(track, structure_of({}), {all[2]}).position));
  EXPECT_TRUE(same_bits(mixed.torque.col(3), rolled(track, structure_of({}), {all[10]}).torque));
}

TEST(LaneBits, AreTheSameOnEveryInstructionSet) {
  RolloutTrack const track = known_track();
  auto const all = trials();
  auto const lanes = static_cast<std::ptrdiff_t>(replicate_lanes);
  // controllers of joints, and servos
  for (auto const& some : {std::vector(all.begin(), all.begin() + lanes), std::vector(all.end() - lanes, all.end())}) {
    Rolled const best = rolled(track, structure_of({}), some);
    for (auto const name : kernels::supported_instruction_sets()) {
      ASSERT_TRUE(kernels::force_instruction_set(name));
      Rolled const forced = rolled(track, structure_of({}), some);
      EXPECT_TRUE(same_bits(best.position, forced.position)) << name;
      EXPECT_TRUE(same_bits(best.velocity, forced.velocity)) << name;
      EXPECT_TRUE(same_bits(best.torque, forced.torque)) << name;
    }
    kernels::release_instruction_set();
  }
}

TEST(LaneBits, OfSumsAndResidualsAreTheSameOnAnyNumberOfThreads) {
  std::vector<RolloutTrack> const tracks{known_track(), track_of(inputs(), {})};
  RolloutTask const task{tracks, {2, structure_of({})}};
  auto const all = trials();
  std::vector<std::vector<RolloutTrial>> const per_track{all, all};
  auto const sums = sums_of_squares(task, all, 1);
  auto const residuals = residuals_of(task, per_track, 1);
  ASSERT_EQ(sums.size(), all.size());
  for (int const threads : {2, 3}) {
    EXPECT_EQ(sums_of_squares(task, all, threads), sums);
    auto const again = residuals_of(task, per_track, threads);
    for (std::size_t track = 0; track < 2; ++track)
      for (std::size_t channel = 0; channel < n_channels; ++channel)
        EXPECT_TRUE(same_bits(again[track].samples[channel], residuals[track].samples[channel]));
  }
  // sums are those of the residuals
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t channel = 0; channel < n_channels; ++channel) {
      double sum = 0.0;
      for (auto const& track : residuals) sum += track.samples[channel].col(static_cast<Eigen::Index>(i)).squaredNorm();
      EXPECT_NEAR(sums[i][channel], sum, 1e-12 * sum);
    }
}

}  // namespace lane_bits_test
