// What enters a chunk of ticks: each lane sees the reference by its own delay, the other channels are those of the
// sample.

#include "engine/simulate/rollout/chunk_inputs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/rollout/loops.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace chunk_inputs_test {

constexpr int ticks_per_sample = 4;
constexpr Eigen::Index first = 7, samples = 40, all = 60;

RolloutTrack track(bool is_straight) {
  PlainInputs in;
  in.rate_hz = 100.0;
  in.ticks_per_sample = ticks_per_sample;
  in.straight = is_straight;
  for (int k = 0; k < all; ++k) {
    in.reference.push_back(std::sin(0.3 * k) + 0.1 * k);
    in.added.push_back(0.01 * k);
    in.outside.push_back(-0.02 * k);
    in.enabled.push_back(k % 5 == 0 ? 0.0 : 1.0);
  }
  RolloutTrack made = track_of(in, {});
  made.segments = {{first, samples, 0.4, 0.0, 0.0}};
  return made;
}

// at a whole tick after the start, of the segment alone: held, or straight from sample to sample
double at_tick(RolloutTrack const& track, long tick) {
  long const last = samples * ticks_per_sample - 1, within = std::min(std::max(tick, 0l), last);
  Eigen::Index const sample = first + within / ticks_per_sample;
  double const share = static_cast<double>(within % ticks_per_sample) / ticks_per_sample;
  bool const is_held = !track.straight_reference || sample + 1 >= first + samples;
  return is_held ? track.reference[sample]
                 : (1.0 - share) * track.reference[sample] + share * track.reference[sample + 1];
}

double expected_at(RolloutTrack const& track, double tick) {
  double const before = std::floor(tick), share = tick - before;
  return (1.0 - share) * at_tick(track, static_cast<long>(before)) +
         share * at_tick(track, static_cast<long>(before) + 1);
}

std::vector<double> delays() {
  std::vector<double> ticks;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) ticks.push_back(0.37 * static_cast<double>(lane));
  ticks[3] = 8.0;
  ticks[5] = 500.0;  // longer than the segment
  return ticks;
}

TEST(ChunkInputs, ShowEachLaneTheReferenceByItsOwnDelay) {
  for (bool const is_straight : {false, true}) {
    RolloutTrack const of = track(is_straight);
    auto const delay = delays();
    ChunkInputs inputs(of, of.segments[0], delay);
    for (std::size_t const begin : {0u, 1u, 37u, 100u}) {
      std::size_t const ticks = std::min<std::size_t>(60, samples * ticks_per_sample - begin);
      TickInputs const in = inputs.at(begin, ticks);
      ASSERT_EQ(in.goal_stride, replicate_lanes);
      for (std::size_t row = 0; row < ticks; ++row)
        for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
          ASSERT_NEAR(in.goal[row * replicate_lanes + lane],
                      expected_at(of, static_cast<double>(begin + row) - delay[lane]), 1e-13)
              << begin << " " << row << " " << lane;
    }
  }
}

TEST(ChunkInputs, ShowAllLanesOneReferenceWhereTheyAreAlikeLate) {
  RolloutTrack const of = track(true);
  for (double const late : {0.0, 2.6}) {
    ChunkInputs inputs(of, of.segments[0], std::vector<double>(replicate_lanes, late));
    TickInputs const in = inputs.at(16, 50);
    ASSERT_EQ(in.goal_stride, 1u);
    for (std::size_t row = 0; row < 50; ++row)
      ASSERT_NEAR(in.goal[row], expected_at(of, static_cast<double>(16 + row) - late), 1e-13);
  }
}

TEST(ChunkInputs, HoldTheOtherChannelsFromSampleToSample) {
  RolloutTrack of = track(false);
  ChunkInputs inputs(of, of.segments[0], delays());
  TickInputs const in = inputs.at(10, 30);
  for (std::size_t row = 0; row < 30; ++row) {
    auto const sample = first + static_cast<Eigen::Index>((10 + row) / ticks_per_sample);
    EXPECT_EQ(in.added[row], of.added[sample]);
    EXPECT_EQ(in.outside[row], of.outside[sample]);
    EXPECT_EQ(in.enabled[row], of.enabled[sample]);
  }
  of.added.resize(0);
  of.outside.resize(0);
  of.enabled.resize(0);
  ChunkInputs bare(of, of.segments[0], delays());
  TickInputs const none = bare.at(0, 8);
  EXPECT_TRUE(none.added == nullptr && none.outside == nullptr && none.enabled == nullptr);
}

TEST(ChunkInputs, WithoutAReferenceStayWhereTheSegmentBegins) {
  RolloutTrack of = track(false);
  of.reference.resize(0);
  ChunkInputs inputs(of, of.segments[0], std::vector<double>(replicate_lanes, 0.0));
  for (std::size_t row = 0; row < 8; ++row) EXPECT_EQ(inputs.at(0, 8).goal[row], 0.4);
}

}  // namespace chunk_inputs_test
