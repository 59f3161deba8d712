// Instruments, noises, motions and loops are what the header says.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "concealed/case_list.hpp"
#include "concealed/noise.hpp"
#include "concealed/sensors.hpp"

namespace concealed {
namespace loop_laws_test {

Recipe const all_recipes[] = {Recipe::multisine, Recipe::staircase, Recipe::creep,
                              Recipe::mixed,     Recipe::chirp,     Recipe::pick_and_place,
                              Recipe::everyday,  Recipe::one_speed, Recipe::narrow};
char const* const all_joints[] = {"elbow", "wrist", "shoulder", "stage", "base", "belt"};
char const* const all_controllers[] = {"pd", "soft_pd", "pid", "cascade", "stiff_cascade"};

TEST(ConcealedEncoder, ReadsTheNearestOfItsPositions) {
  auto const encoder = Encoder::per_turn(14, 2.0 * std::numbers::pi);
  for (int i = -1000; i < 1000; ++i) {
    double const q = 0.00173 * i, reading = encoder.read(q);
    EXPECT_LE(std::abs(reading - q), 0.5 * encoder.step() * (1.0 + 1e-9));
    EXPECT_NEAR(reading / encoder.step(), std::round(reading / encoder.step()), 1e-9);
  }
}

TEST(ConcealedConverter, SaturatesAtItsRange) {
  Converter const converter(12, 5.0);
  EXPECT_EQ(converter.read(7.0), 5.0);
  EXPECT_EQ(converter.read(-7.0), -5.0);
  EXPECT_LE(std::abs(converter.read(1.2345) - 1.2345), 0.5 * converter.step());
}

TEST(ConcealedNoise, HasTheStatedSpreadAndMemory) {
  double const std = 0.3, memory_s = 0.008;
  ColouredNoise noise(Random(5, "test"), std, memory_s, tick_s);
  int const n = 400000;
  double sum = 0.0, squares = 0.0, products = 0.0, last = 0.0;
  for (int i = 0; i < n; ++i) {
    double const x = noise.next();
    sum += x;
    squares += x * x;
    products += x * last;
    last = x;
  }
  // n tick / (2 memory) independent values: five standard deviations of mean and variance
  double const independent = n * tick_s / (2.0 * memory_s);
  EXPECT_NEAR(sum / n, 0.0, 5.0 * std / std::sqrt(independent));
  EXPECT_NEAR(squares / n, std * std, 5.0 * std * std * std::sqrt(2.0 / independent));
  EXPECT_NEAR(products / squares, std::exp(-tick_s / memory_s), 5.0 / std::sqrt(independent));
}

TEST(ConcealedNoise, SeparatesPurposesOfOneSeed) {
  std::set<double> first;
  for (char const* purpose : {"white", "coloured", "disturbance", "wander", "jitter"}) {
    for (std::uint64_t seed : {1, 2, 3}) first.insert(Random(seed, purpose).uniform());
  }
  EXPECT_EQ(first.size(), 15u);
}

TEST(ConcealedExcitation, StaysWithinRangeAndSpeedWithoutJumps) {
  MotionLimits const limits{1.2, 2.2};
  for (Recipe recipe : all_recipes) {
    Excitation const motion(recipe, limits, 60.0, 9);
    double last = motion.position(0.0), last_v = 0.0;
    EXPECT_EQ(last, 0.0);
    for (int k = 1; k < 60000; ++k) {
      double const q = motion.position(k * tick_s), v = (q - last) / tick_s;
      // 1.01: the multisine was scaled on samples five ticks apart
      ASSERT_LE(std::abs(q), 1.01 * limits.range) << to_text(recipe);
      ASSERT_LE(std::abs(v), 1.01 * limits.speed) << to_text(recipe);
      ASSERT_LE(std::abs(v - last_v), 0.02 * limits.speed) << to_text(recipe) << " jerks at " << k;
      last = q;
      last_v = v;
    }
  }
}

TEST(ConcealedExcitation, TurnsOnInOneDirectionOnly) {
  MotionLimits const limits{1.2, 2.2};
  Excitation const motion(Recipe::one_direction, limits, 40.0, 9);
  double fastest = 0.0;
  for (int k = 1; k < 40000; ++k) {
    double const v = (motion.position(k * tick_s) - motion.position((k - 1) * tick_s)) / tick_s;
    ASSERT_GE(v, -1e-9);
    ASSERT_LE(v, 1.01 * limits.speed);
    fastest = std::max(fastest, v);
  }
  EXPECT_GT(fastest, 0.5 * limits.speed);
}

TEST(ConcealedExcitation, IsAnotherMotionWithAnotherSeed) {
  MotionLimits const limits{1.2, 2.2};
  for (Recipe recipe : {Recipe::multisine, Recipe::staircase, Recipe::creep, Recipe::mixed, Recipe::pick_and_place,
                        Recipe::everyday, Recipe::one_direction}) {
    Excitation const one(recipe, limits, 30.0, 1), other(recipe, limits, 30.0, 2);
    double difference = 0.0;
    for (int k = 0; k < 30000; ++k)
      difference = std::max(difference, std::abs(one.position(k * tick_s) - other.position(k * tick_s)));
    EXPECT_GT(difference, 0.01 * limits.range) << to_text(recipe);
  }
}

TEST(ConcealedLoop, ForgetsABlow) {
  // without friction, which would hide a slow or undamped loop: a torque pulse of one tick leaves no trace after a
  // second
  for (auto const* name : all_joints) {
    for (auto const* controller_name : all_controllers) {
      JointDesign const joint = joint_named(name);
      Baseline bare = joint.baseline;
      bare.coulomb = 0.0;
      bare.viscous = 0.0;
      Plant const plant(bare, {});
      auto error_after = [&](bool with_pulse) {
        Controller controller(controller_named(controller_name), bare.inertia, joint.torque_limit, tick_s);
        State state = plant.at_rest(0.0);
        double pending = 0.0;
        double largest = 0.0;
        for (int k = 0; k < 3000; ++k) {
          Drive const drive{pending, with_pulse && k == 1000 ? joint.torque_limit : 0.0};
          pending = controller.command(0.0, state.q());
          plant.advance(state, drive, tick_s);
          if (k >= 2500) largest = std::max(largest, std::abs(state.q()));
        }
        return largest;
      };
      double const moved_by_pulse = joint.torque_limit * tick_s * 0.05 / bare.inertia;  // over 50 ms, unhindered
      EXPECT_LT(std::abs(error_after(true) - error_after(false)), 1e-3 * moved_by_pulse)
          << name << " " << controller_name;
    }
  }
}

TEST(ConcealedLoop, FollowsItsReferenceWithinItsLimits) {
  for (Case const& one_case : sealed_cases()) {
    Excitation const motion = one_case.excitation(true);
    RunPlan plan = one_case.plan(motion, true);
    plan.duration_s = 12.0;
    LoopRun const run = run_closed_loop(one_case.rig, one_case.laws(), plan);
    double worst = 0.0, torque = 0.0;
    for (std::size_t k = 0; k < run.recording.time.size(); ++k) {
      worst = std::max(worst, std::abs(run.recording.reference[k] - run.recording.position[k]));
      torque = std::max(torque, std::abs(run.truth.motor[k]));
    }
    EXPECT_LT(worst, 0.2 * one_case.rig.joint.limits.range) << one_case.name;
    EXPECT_LT(torque, 0.9 * one_case.rig.joint.torque_limit) << one_case.name;
  }
}

TEST(ConcealedLoop, AppliesTheCommandOneTickLater) {
  Rig rig = without_noise({joint_named("elbow"), controller_named("pd"), noise_named("none"), 0});
  Excitation const motion(Recipe::staircase, rig.joint.limits, 5.0, 3);
  LoopRun const run = run_closed_loop(rig, {}, {motion, 5.0, 3});
  Controller controller(rig.controller, rig.joint.baseline.inertia, rig.joint.torque_limit, tick_s);
  double pending = 0.0;
  for (std::size_t k = 0; k < run.recording.time.size(); ++k) {
    ASSERT_EQ(run.recording.torque[k], pending);
    pending = controller.command(run.recording.reference[k], run.recording.position[k]);
  }
}

}  // namespace loop_laws_test
}  // namespace concealed
