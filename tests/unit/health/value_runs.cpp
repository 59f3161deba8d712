// A source slower than its log is told from a coarse encoder, whatever its period, its phase and its jitter.

#include "engine/data/health/value_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace torquescope {
namespace value_runs_test {

double motion(double row) { return std::sin(0.004 * row) + 0.3 * std::sin(0.017 * row + 1.0); }

// a log of n rows of a source that is read every `period` rows, each time up to `jitter` periods off
std::vector<double> held(double period, double jitter, std::size_t n = 6000) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  std::vector<double> values;
  double read = -0.3 * period, next = 0.7 * period;
  for (double count = 2; values.size() < n;) {
    if (static_cast<double>(values.size()) >= next) {
      read = next;
      next = (count++ - 0.3 + jitter * uniform(engine)) * period;
      continue;
    }
    values.push_back(motion(read));
  }
  return values;
}

std::vector<double> coarse(double step, std::size_t n = 6000) {
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(step * std::round(motion(static_cast<double>(i)) / step));
  return values;
}

TEST(SlowSource, IsFoundWithItsPeriodAndTheFirstRowOfEachRun) {
  for (double period : {2.0, 2.5, 3.7, 10.0, 15.0, 33.3})
    for (double jitter : {0.0, 0.2, 0.5}) {
      auto const values = held(period, jitter);
      auto const source = slow_source_of(values);
      ASSERT_TRUE(source.is_slow()) << period << " " << jitter;
      EXPECT_NEAR(source.rows, period, 0.03 * period);
      EXPECT_NEAR(static_cast<double>(source.samples.size()), 6000 / period, 0.03 * 6000 / period);
      for (std::size_t k = 1; k < source.samples.size(); ++k)
        EXPECT_NE(values[source.samples[k]], values[source.samples[k] - 1]) << k;
    }
}

TEST(SlowSource, GoesOnWhereTheValueRests) {
  auto values = held(10.0, 0.0);
  for (std::size_t i = 2000; i < 3000; ++i) values[i] = values[1999];
  auto const source = slow_source_of(values);
  ASSERT_TRUE(source.is_slow());
  for (std::size_t k = 1; k < source.samples.size(); ++k)
    EXPECT_LE(source.samples[k] - source.samples[k - 1], 11U) << source.samples[k];
}

TEST(SlowSource, IsNoCoarseEncoderAndNoSignalOfItsOwnRate) {
  for (double step : {1e-6, 1e-3, 0.01, 0.05, 0.2}) EXPECT_FALSE(slow_source_of(coarse(step)).is_slow()) << step;
  EXPECT_FALSE(slow_source_of(held(1.0, 0.0)).is_slow());
  EXPECT_FALSE(slow_source_of(std::vector<double>(500, 1.0)).is_slow());
}

TEST(SlowSource, IsNoLossOfSinglePackets) {
  std::mt19937 engine(3);
  auto values = held(1.0, 0.0);
  for (std::size_t i = 1; i < values.size(); ++i)
    if (engine() % 10 < 4) values[i] = values[i - 1];
  EXPECT_FALSE(slow_source_of(values).is_slow());
}

}  // namespace value_runs_test
}  // namespace torquescope
