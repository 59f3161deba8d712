// A strip keeps every sample of a joint that rests, turns and dithers, and says which of them show motion.

#include "engine/infer/decision/strip.hpp"

#include <gtest/gtest.h>

#include "unit/decision/plants.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace strip_test {

double time_of(Strip const& strip, Eigen::Index sample) { return strip.motion.time_s[sample]; }

TEST(Strip, QuietSamplesAreThoseOfTheRests) {
  GivenJoint joint;
  joint.rests = true;
  Strip const strip = strip_of_joint(joint);
  ASSERT_EQ(static_cast<Eigen::Index>(strip.is_quiet.size()), strip.size());
  constexpr double window_s = 0.05;  // half a period of the cut-off
  Eigen::Index in_rest = 0, moving = 0;
  for (Eigen::Index k = 0; k < strip.size(); ++k) {
    double const t = time_of(strip, k), u = std::fmod(t, rest_period_s);
    bool const is_quiet = strip.is_quiet[static_cast<std::size_t>(k)] != 0;
    if (u >= rest_from_s && u < rest_until_s - 0.003) {
      ++in_rest;
      EXPECT_TRUE(is_quiet) << t;
    }
    // however the window lies round it, the joint moves at least three steps
    double least = 1.0;
    for (double from = t - window_s; from <= t; from += 0.005) {
      double low = 1e9, high = -1e9;
      for (double at = from; at <= from + window_s + 1e-9; at += 0.005) {
        low = std::min(low, instant_of(joint, at).q);
        high = std::max(high, instant_of(joint, at).q);
      }
      least = std::min(least, high - low);
    }
    if (least < 3.0 * joint.encoder_step || t < window_s || t > 20.0 - window_s) continue;
    ++moving;
    EXPECT_FALSE(is_quiet) << t;
  }
  EXPECT_GT(in_rest, 700);
  EXPECT_GT(moving, 1100);
  EXPECT_NEAR(strip.quiet_share(), 0.39, 0.03);
}

// The window is half a period of the motion's cut-off, 11 samples: a stand of 14 is quiet, one of 8 may be chance. How
// far the torque is low-passed says nothing of it
TEST(Strip, AStandShorterThanTheWindowIsNotQuiet) {
  Recording recording = recording_of({});
  constexpr double step = 2e-5, steps_per_sample = 5.0;
  double place = 0.0;
  for (Eigen::Index k = 0; k < recording.position.size(); ++k) {
    bool const stands = (k > 1000 && k < 1014) || (k > 2000 && k < 2008);
    if (!stands) place += steps_per_sample * step;
    recording.position[k] = place;
  }
  struct CutOffs {
    double motion_hz, torque_hz;
  };
  // a position that is not filtered has the torque's window
  for (auto const [motion_hz, torque_hz] : {CutOffs{10.0, 10.0}, CutOffs{10.0, 5.0}, CutOffs{0.0, 10.0}}) {
    FilterOptions filter = ten_hertz();
    filter.cutoff_hz = motion_hz;
    filter.parallel_cutoff_hz = torque_hz;
    Strip const strip = strip_of(recording, strip_filters(recording, filter, {}));
    for (Eigen::Index k = 0; k < strip.size(); ++k) {
      auto const sample = std::lround(time_of(strip, k) * recording.rate_hz);
      EXPECT_EQ(strip.is_quiet[static_cast<std::size_t>(k)] != 0, sample >= 1000 && sample < 1014) << sample;
    }
  }
}

TEST(Strip, RowsKeepEverythingButTheEdges) {
  GivenJoint joint;
  joint.rests = true;
  Recording recording = recording_of(joint);
  auto const filters = strip_filters(recording, ten_hertz(), {});
  Strip const strip = strip_of(recording, filters);
  // 20 s at 25 Hz without three periods of 10 Hz at either end
  EXPECT_NEAR(static_cast<double>(strip.rows.size()), 485.0, 2.0);
  EXPECT_EQ(strip.row_share(), 1.0);
  recording.left_out.push_back({8.0, 10.0});
  Strip const holed = strip_of(recording, filters);
  EXPECT_LE(holed.row_share(), 1.0 - 2.0 / 19.4 + 0.005);
  EXPECT_GT(holed.row_share(), 1.0 - 3.0 / 19.4);
  EXPECT_NEAR(holed.row_share(), static_cast<double>(holed.rows.size()) / static_cast<double>(strip.rows.size()),
              1e-12);
}

// Forward at a fifth of a step for each sample, a stand, and back; every other sample one step higher than it is
TEST(Strip, DirectionTurnsWithTheMotionAndNotWithDither) {
  constexpr double step = 1e-4;
  constexpr Eigen::Index n = 4000, stands = 1400, moves = 1900, turns = 2500;
  Recording recording = recording_of({});
  recording.rows.encoder_step = step;
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index const way = k < stands ? k : k < moves ? stands : k < turns ? k - moves + stands : 2 * turns - k - 500;
    recording.position[k] = step * (std::floor(0.2 * static_cast<double>(way)) + static_cast<double>(k % 2));
  }
  Strip const strip = strip_of(recording, strip_filters(recording, ten_hertz(), {}));
  Eigen::Index flips = 0, at = 0;
  for (Eigen::Index k = 0; k < strip.size(); ++k) {
    // low-passed as the torque is: it rings beside the turn
    bool const is_beside = std::abs(time_of(strip, k) - static_cast<double>(turns) / recording.rate_hz) < 0.2;
    EXPECT_NEAR(std::abs(strip.direction[k]), 1.0, is_beside ? 1.0 : 1e-3);
    if (k > 0 && strip.direction[k] * strip.direction[k - 1] < 0.0) {
      ++flips;
      at = static_cast<Eigen::Index>(std::lround(time_of(strip, k) * recording.rate_hz));
    }
  }
  EXPECT_GT(strip.direction[0], 0.0);
  EXPECT_EQ(flips, 1);
  EXPECT_NEAR(static_cast<double>(at), static_cast<double>(turns), 10.0);
}

TEST(Strip, ResolutionIsTheStepOrTheNoiseOfThePosition) {
  GivenJoint joint;
  joint.encoder_step = 1e-3;
  Recording recording = recording_of(joint);
  // steps that are seen, where no file has told them
  recording.rows.encoder_step = 0.0;
  EXPECT_NEAR(position_resolution(recording), 1e-3, 1e-9);
  recording.rows.encoder_step = 2e-5;
  EXPECT_EQ(position_resolution(recording), 2e-5);
  recording.rows.encoder_step = 0.0;
  RandomStream random({4, 0, RandomDomain::test}, 0, 0);
  for (double& q : recording.position) q += 1e-3 * random.normal();
  EXPECT_NEAR(position_resolution(recording), 4e-3, 0.4e-3);
}

}  // namespace strip_test
