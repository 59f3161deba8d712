// What the mismatch map says of clean recordings: nothing, but for the promised one in twenty on every axis.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "engine/infer/locate/map_axes.hpp"
#include "engine/infer/locate/mismatch_map.hpp"
#include "unit/locate/synthetic_rows.hpp"

namespace torquescope {
namespace mismatch_map_null_test {

constexpr int recordings = 400;
constexpr Eigen::Index replicates = 99;
// four binomial standard errors
double const tolerance = 4.0 * std::sqrt(recordings * 0.05 * 0.95);

struct Count {
  int small_p = 0, below_half = 0, with_regions = 0, without_share = 0;
};

std::array<Count, map_axes.size()> count_clean(double memory) {
  std::array<Count, map_axes.size()> counts;
  for (std::uint32_t set = 0; set < recordings; ++set) {
    auto const made = test::synthetic_rows({1000, 100.0, replicates, memory, set});
    auto const map = mismatch_map(made.rows, made.scales, 1);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      counts[i].small_p += map[i].p <= 0.05;
      counts[i].below_half += map[i].p <= 0.5;
      counts[i].with_regions += !map[i].regions.empty();
      counts[i].without_share += map[i].energy_share == 0.0;
    }
  }
  return counts;
}

class CleanRecordings : public ::testing::TestWithParam<double> {};

TEST_P(CleanRecordings, AreRejectedOnceInTwentyOnEveryAxis) {
  auto const counts = count_clean(GetParam());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    SCOPED_TRACE(word(map_axes[i]));
    RecordProperty(word(map_axes[i]) + "_p", counts[i].small_p);
    RecordProperty(word(map_axes[i]) + "_regions", counts[i].with_regions);
    EXPECT_NEAR(counts[i].small_p, 0.05 * recordings, tolerance);
    EXPECT_NEAR(counts[i].below_half, 0.5 * recordings, 4.0 * std::sqrt(recordings * 0.25));
    EXPECT_LE(counts[i].with_regions, 0.07 * recordings);
    // energy is skewed: more than half of the recordings have less than the replicates' average, and show none
    EXPECT_GT(counts[i].without_share, 0.5 * recordings - tolerance);
    EXPECT_LT(counts[i].without_share, 0.75 * recordings);
  }
}

INSTANTIATE_TEST_SUITE_P(Noise, CleanRecordings, ::testing::Values(0.0, 0.9),
                         [](auto const& noise) { return noise.param == 0.0 ? "white" : "coloured"; });

}  // namespace mismatch_map_null_test
}  // namespace torquescope
