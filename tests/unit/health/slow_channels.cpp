// Channels of a slow source are read at their own rates: the recording is that of their samples, without a hole.

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/data/health/make_recording.hpp"
#include "engine/data/motion.hpp"
#include "unit/health/sample_recording.hpp"

namespace torquescope {
namespace slow_channels_test {

using health_test::sample_options;
using health_test::sample_table;

// every column is renewed on one row in so many, from another row on
RawTable held_table(std::size_t position_rows, std::size_t torque_rows) {
  auto table = sample_table({.rate_hz = 1000, .encoder_step = 1e-6, .noise = 0.0});
  auto const hold = [](std::vector<double>& values, std::size_t rows, std::size_t phase) {
    for (std::size_t i = 1; i < values.size(); ++i)
      if (i < phase || (i - phase) % rows != 0) values[i] = values[i - 1];
  };
  hold(table.columns[1], position_rows, 3);
  hold(table.columns[2], torque_rows, 1);
  return table;
}

Recording recording_of(RawTable const& table) { return make_recording(table, sample_options(), {"recording", {}, {}}); }

TEST(SlowChannels, HaveTheirOwnRatesAndTheMotionBetween) {
  auto const sound = recording_of(sample_table({.rate_hz = 1000, .encoder_step = 1e-6, .noise = 0.0}));
  auto const slow = recording_of(held_table(10, 4));
  EXPECT_NEAR(slow.rows.position_hz, 100.0, 1e-6);
  EXPECT_NEAR(slow.rows.torque_hz, 250.0, 1e-6);
  EXPECT_EQ(slow.rate_hz, 1000.0);
  EXPECT_TRUE(slow.left_out.empty());
  auto const found = std::count_if(slow.findings.begin(), slow.findings.end(),
                                   [](Finding const& one) { return one.kind == FindingKind::slow_source; });
  EXPECT_EQ(found, 2);
  Eigen::Index const inside = slow.position.size() - 100;
  EXPECT_LT((slow.position - sound.position).segment(50, inside).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(SlowChannels, RefuseACutOffAboveHalfTheirRate) {
  auto const slow = recording_of(held_table(10, 4));
  FilterOptions filter;
  filter.cutoff_hz = 40.0;
  filter.parallel_cutoff_hz = 20.0;
  EXPECT_NO_THROW(differentiate(slow, filter, {}));
  filter.cutoff_hz = 60.0;
  EXPECT_THROW(differentiate(slow, filter, {}), Error);
  filter.cutoff_hz = 40.0;
  filter.parallel_cutoff_hz = 130.0;
  EXPECT_THROW(differentiate(slow, filter, {}), Error);
}

}  // namespace slow_channels_test
}  // namespace torquescope
