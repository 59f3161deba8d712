// The null distribution is the true one: on recordings that lack nothing, p-values are uniform.

#include <gtest/gtest.h>

#include <cmath>

#include "unit/replicates/calibration.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace twin_calibration_test {

// Kolmogorov: 1 % in the family of six statistics; p comes in steps of 1 / (twins + 1)
double largest_distance(std::size_t records, std::size_t twins) {
  constexpr double quantile = 1.89;  // of sqrt(n) D at 1 - 0.01 / 6
  return quantile / std::sqrt(static_cast<double>(records)) + 1.0 / static_cast<double>(twins + 1);
}

TEST(TwinCalibration, GivesUniformPValuesOnCleanRecordings) {
  constexpr std::uint32_t records = 40;
  constexpr std::size_t twins = 60;
  auto const result = calibrate(records, twins);
  for (std::size_t s = 0; s < statistic_names.size(); ++s) {
    double const distance = kolmogorov_smirnov(result.p[s]);
    std::printf("%-18s distance %.3f, %2.0f %% of p at or below 5 %%\n", statistic_names[s], distance,
                100.0 * share_below(result.p[s], 0.05));
    // fast energy sets the disturbance when it is high: its own p has no lower tail
    if (std::string(statistic_names[s]) == "fast energy") continue;
    EXPECT_LT(distance, largest_distance(records, twins)) << statistic_names[s];
  }
  // level: three standard errors of the mean, from the ratios' own spread
  double mean_ratio = 0.0, squares = 0.0;
  for (double ratio : result.energy_ratio) mean_ratio += ratio / records;
  for (double ratio : result.energy_ratio) squares += (ratio - mean_ratio) * (ratio - mean_ratio);
  double const spread = std::sqrt(squares / (records - 1.0));
  std::printf("energy ratio %.3f +- %.3f\n", mean_ratio, spread);
  EXPECT_NEAR(mean_ratio, 1.0, 3.0 * spread / std::sqrt(static_cast<double>(records)));
}

}  // namespace twin_calibration_test
