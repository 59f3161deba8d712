// A trial is the same to the last bit whatever stands beside it, on any number of threads and any instruction set.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/rollout/rollout_residuals.hpp"
#include "kernels/dispatch.hpp"
#include "unit/rollout/loops.hpp"

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
  return made;
}

TEST(LaneBits, DoNotDependOnTheNeighbours) {
  RolloutTrack const track = track_of(inputs(), {0.01, 0.2, 0.3});
  auto const all = trials();
  RolloutStructure const structure = structure_of(PlainController{});
  // sixteen at a time, at places of their own
  for (std::size_t first = 0; first < all.size(); first += 5) {
    std::vector<RolloutTrial> together;
    for (std::size_t i = 0; i < twin_lanes; ++i) together.push_back(all[(first + 7 * i) % all.size()]);
    Rolled const beside = rolled(track, structure, together);
    for (std::size_t i = 0; i < twin_lanes; ++i) {
      auto const lane = static_cast<Eigen::Index>(i);
      Rolled const alone = rolled(track, structure, {together[i]});
      std::size_t const which = (first + 7 * i) % all.size();
      EXPECT_TRUE(same_bits(beside.position.col(lane), alone.position)) << which;
      EXPECT_TRUE(same_bits(beside.velocity.col(lane), alone.velocity)) << which;
      EXPECT_TRUE(same_bits(beside.torque.col(lane), alone.torque)) << which;
    }
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
  RolloutTrack const track = track_of(inputs(), {0.01, 0.2, 0.3});
  auto all = trials();
  all.resize(twin_lanes, all[0]);
  Rolled const best = rolled(track, structure_of({}), all);
  for (auto const name : kernels::supported_instruction_sets()) {
    ASSERT_TRUE(kernels::force_instruction_set(name));
    Rolled const forced = rolled(track, structure_of({}), all);
    EXPECT_TRUE(same_bits(best.position, forced.position)) << name;
    EXPECT_TRUE(same_bits(best.velocity, forced.velocity)) << name;
    EXPECT_TRUE(same_bits(best.torque, forced.torque)) << name;
  }
  kernels::release_instruction_set();
}

TEST(LaneBits, OfSumsAndResidualsAreTheSameOnAnyNumberOfThreads) {
  std::vector<RolloutTrack> const tracks{track_of(inputs(), {0.01, 0.2, 0.3}), track_of(inputs(), {})};
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
