// Twins that follow the measured motion are no wilder and no tamer than recordings that lack nothing, whatever memory
// the noise of the torque channel has.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "unit/replicates/calibration.hpp"

using namespace torquescope;
using namespace torquescope::test;

TEST(CalibrationWithoutReference, RejectsNoMoreThanItSays) {
  constexpr std::uint32_t records = 24;
  constexpr std::size_t twins = 39;  // p of 5 % is the second largest
  auto const result =
      calibrate(records, twins, 0.0, 2, 0, [](Recording& recording, CleanJoint const& joint, std::uint32_t index) {
        // every third has white noise alone
        double const share = index % 3 == 0 ? 0.0 : 0.015;
        double const corner_hz = index % 2 == 0 ? 4.0 : 12.0;
        recording = without_reference(std::move(recording), share * joint.truth[2], corner_hz, index);
      });
  EXPECT_EQ(result.not_white, static_cast<int>(records));  // all are led along the motion
  // binomial, 24 records: 6 or more of 5 % happen once in 1000, in the family of six once in 170
  constexpr double most_at_5_percent = 5.0 / records;
  double mean = 0.0;
  for (double ratio : result.energy_ratio) mean += ratio / records;
  std::printf("energy ratio %.3f\n", mean);
  for (std::size_t s = 0; s < statistic_names.size(); ++s) {
    std::printf("%-18s %2.0f %% of p at or below 5 %%, %2.0f %% at or below 50 %%\n", statistic_names[s],
                100.0 * share_below(result.p[s], 0.05), 100.0 * share_below(result.p[s], 0.5));
    EXPECT_LE(share_below(result.p[s], 0.05), most_at_5_percent) << statistic_names[s];
    // levels are fitted to the same record: p of energies gather about the middle, but none at the top
    EXPECT_GE(share_below(result.p[s], 0.75), 0.4) << statistic_names[s];
  }
  EXPECT_NEAR(mean, 1.0, 0.15);
}
