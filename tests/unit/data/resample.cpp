// Interpolation between uneven samples: its effects.

#include "engine/data/resample.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace resample_test {

std::vector<double> uneven_times(std::uint32_t seed, std::size_t n, double step) {
  RandomStream stream({21, 0, RandomDomain::test}, 0, seed);
  std::vector<double> times{0.0};
  while (times.size() < n) times.push_back(times.back() + step * stream.uniform(0.3, 1.7));
  return times;
}

std::vector<double> queries_within(std::vector<double> const& times, std::size_t n) {
  std::vector<double> queries;
  for (std::size_t k = 0; k < n; ++k)
    queries.push_back(times.back() * static_cast<double>(k) / static_cast<double>(n - 1));
  queries.back() = times.back();
  return queries;
}

template <class Function>
std::vector<double> values_at(std::vector<double> const& times, Function&& function) {
  std::vector<double> values;
  for (double t : times) values.push_back(function(t));
  return values;
}

TEST(Interpolation, ReproducesParabolasAnywhere) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    auto const times = uneven_times(seed, 3 + seed, 0.1);
    auto const parabola = [&](double t) { return 2.0 - 3.0 * t + 0.7 * seed * t * t; };
    auto const queries = queries_within(times, 101);
    auto const found = interpolate(times, values_at(times, parabola), queries);
    for (std::size_t k = 0; k < queries.size(); ++k) ASSERT_NEAR(found[k], parabola(queries[k]), 1e-12 * (1 + seed));
  }
}

TEST(Interpolation, PassesThroughTheSamplesExactly) {
  auto const times = uneven_times(3, 50, 0.01);
  auto const values = values_at(times, [](double t) { return std::sin(40 * t); });
  auto const found = interpolate(times, values, times);
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(found[k], values[k], 1e-15);
}

TEST(Interpolation, IsLinearInTheValues) {
  auto const times = uneven_times(4, 60, 0.01);
  auto const queries = queries_within(times, 200);
  auto const a = values_at(times, [](double t) { return std::sin(30 * t); });
  auto const b = values_at(times, [](double t) { return t > 0.3 ? 1.0 : 0.0; });
  std::vector<double> both;
  for (std::size_t k = 0; k < times.size(); ++k) both.push_back(2 * a[k] - 5 * b[k]);
  auto const found_a = interpolate(times, a, queries), found_b = interpolate(times, b, queries);
  auto const found = interpolate(times, both, queries);
  for (std::size_t k = 0; k < queries.size(); ++k) EXPECT_NEAR(found[k], 2 * found_a[k] - 5 * found_b[k], 1e-13);
}

TEST(Interpolation, ErrorFallsWithTheThirdPowerOfTheStep) {
  auto const largest_error = [](double step) {
    auto const times = uneven_times(5, static_cast<std::size_t>(2.0 / step), step);
    auto const queries = queries_within(times, 5000);
    auto const found = interpolate(times, values_at(times, [](double t) { return std::sin(7 * t); }), queries);
    double worst = 0;
    for (std::size_t k = 0; k < queries.size(); ++k)
      worst = std::max(worst, std::fabs(found[k] - std::sin(7 * queries[k])));
    return worst;
  };
  // 4^3 = 64 in the limit; random steps make it vary
  EXPECT_GT(largest_error(0.02) / largest_error(0.005), 40.0);
}

}  // namespace resample_test
}  // namespace torquescope
