#include "engine/data/filter_suggestion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "engine/data/filter_checks.hpp"

namespace torquescope {
namespace filter_suggestion_test {

// a sine of 1 rad, and one of `wobble` rad at six times its frequency, in steps of an encoder
Recording sine(double hz, double rate_hz, double seconds, double step = 1e-9, double wobble = 0.0) {
  Recording recording;
  recording.rate_hz = rate_hz;
  auto const n = static_cast<Eigen::Index>(seconds * rate_hz);
  recording.position.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    double const phase = 2 * std::numbers::pi * hz * static_cast<double>(k) / rate_hz;
    recording.position[k] = step * std::round((std::sin(phase) + wobble * std::sin(6 * phase)) / step);
  }
  recording.rows.encoder_step = step;
  return recording;
}

TEST(FilterSuggestion, IsTenTimesTheMotion) {
  auto const found = suggest_filter(sine(0.5, 1000, 20, 1e-9, 0.027), 20);
  // the fourth-order low-pass, run twice, lets 98 % of 3 Hz through from 4 to 6 Hz on
  EXPECT_GT(found.motion_hz, 3.0);
  EXPECT_LT(found.motion_hz, 6.0);
  EXPECT_NEAR(found.options.cutoff_hz, 10 * found.motion_hz, 0.15 * 10 * found.motion_hz);
  EXPECT_EQ(found.limit, FilterSuggestion::Limit::motion);
}

TEST(FilterSuggestion, StaysBelowTheNoiseOfACoarseEncoder) {
  auto const fine = suggest_filter(sine(0.5, 1000, 20, 1e-9, 0.027), 20);
  auto const coarse = suggest_filter(sine(0.5, 1000, 20, 2 * std::numbers::pi / 2000, 0.027), 20);
  EXPECT_GT(coarse.noise_hz, 3.0);
  EXPECT_LT(coarse.options.cutoff_hz, fine.options.cutoff_hz);
  EXPECT_EQ(coarse.limit, FilterSuggestion::Limit::noise);
}

TEST(FilterSuggestion, LeavesFrictionAtReversalsOfASlowMotion) {
  auto const found = suggest_filter(sine(0.1, 1000, 60), 60);
  EXPECT_GE(found.options.cutoff_hz, 15);
  EXPECT_EQ(found.limit, FilterSuggestion::Limit::slow_motion);
}

TEST(FilterSuggestion, LeavesMostOfTheTimeBetweenReversals) {
  // 4 reversals a second of a coarse encoder: where the acceleration is hardly noisy, little is left between them
  auto const found = suggest_filter(sine(2.0, 200, 20, 2 * std::numbers::pi / 200), 20);
  EXPECT_EQ(found.limit, FilterSuggestion::Limit::reversals);
  EXPECT_GT(found.options.cutoff_hz, found.noise_hz);
  EXPECT_LE(found.options.cutoff_hz, 2.2 * found.noise_hz) << "rounding included";
}

TEST(FilterSuggestion, KeepsWhatEveryCheckOfAJobWants) {
  for (double rate_hz : {100.0, 187.6, 200.0, 500.0, 999.0, 1000.0, 4000.0})
    for (double hz : {0.1, 0.5, 2.0, 6.0})
      for (double seconds : {6.0, 30.0}) {
        auto const options = suggest_filter(sine(hz, rate_hz, seconds), seconds).options;
        Section const filter{"filter", {}, {}};
        EXPECT_NO_THROW(check_cutoff("cutoff_hz", options.cutoff_hz, rate_hz, filter));
        EXPECT_NO_THROW(decimation_factor(options, rate_hz, filter));
        auto const edges = 2 * static_cast<double>(edge_samples(options, rate_hz));
        EXPECT_LE(edges, 0.25 * seconds * rate_hz) << rate_hz << " " << hz << " " << seconds;
        EXPECT_EQ(options.parallel_cutoff_hz, options.cutoff_hz / 2);
        if (options.decimate_to_hz > 0) {
          EXPECT_GE(options.decimate_to_hz, 2.5 * options.parallel_cutoff_hz * (1 - 1e-9));
          EXPECT_GE(options.decimate_to_hz * seconds, 1000 * (1 - 1e-9)) << "rows for a search";
        }
      }
}

TEST(ArmFilterSuggestion, IsTenTimesTheMotionOfAllJointsWithoutAFloor) {
  // a joint alone keeps 20 Hz for friction at its reversals; those rows of an arm are left out
  std::vector<Recording> const joints{sine(0.1, 1000, 60), sine(0.2, 1000, 60)};
  auto const found = suggest_arm_filter(joints, 60);
  EXPECT_GT(found.motion_hz, 0.2);
  EXPECT_LT(found.motion_hz, 0.6);
  EXPECT_GE(found.options.cutoff_hz, 2.0);
  EXPECT_LE(found.options.cutoff_hz, 6.0);
  EXPECT_GE(suggest_filter(joints[1], 60).options.cutoff_hz, 15);
}

TEST(ArmFilterSuggestion, IsNotLedByRippleOfAJointThatHardlyMoves) {
  std::vector<Recording> joints{sine(0.2, 1000, 60), sine(0.2, 1000, 60)};
  auto const smooth = suggest_arm_filter(joints, 60);
  joints[1].position = 0.01 * sine(10.0, 1000, 60).position;
  EXPECT_EQ(suggest_arm_filter(std::span(joints).first(1), 60).motion_hz, smooth.motion_hz);
  EXPECT_EQ(suggest_arm_filter(joints, 60).motion_hz, smooth.motion_hz);
}

}  // namespace filter_suggestion_test
}  // namespace torquescope
