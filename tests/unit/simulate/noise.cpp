#include "engine/simulate/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace torquescope;

namespace noise_test {

RandomKey const key{11, 0, RandomDomain::simulation};

std::vector<double> drawn(ColouredNoise noise, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(noise.next());
  return values;
}

double autocovariance(std::vector<double> const& values, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t i = lag; i < values.size(); ++i) sum += values[i] * values[i - lag];
  return sum / static_cast<double>(values.size() - lag);
}

double normal_at(RandomKey const& address, NoiseStream stream, std::size_t index) {
  double normal = 0.0;
  addressed_normals(address, stream, index, {&normal, 1});
  return normal;
}

TEST(AddressedNoise, DependsOnTheAddressOnly) {
  double const first = normal_at(key, NoiseStream::torque_white, 77);
  normal_at(key, NoiseStream::position, 3);
  drawn(ColouredNoise(key, NoiseStream::disturbance, 1.0, 0.1, 1000.0), 100);
  EXPECT_EQ(normal_at(key, NoiseStream::torque_white, 77), first);
}

TEST(AddressedNoise, OfManyHasTheBitsOfEachAddressOfTheRandomStream) {
  // tails too: one of seven
  std::vector<double> normals(1000);
  for (std::uint32_t first : {0u, 5u, 4'000'000'000u}) {
    addressed_normals(key, NoiseStream::torque_coloured, first, normals);
    for (std::uint32_t i = 0; i < normals.size(); ++i) {
      RandomStream stream(key, static_cast<std::uint32_t>(NoiseStream::torque_coloured), first + i);
      ASSERT_EQ(normals[i], stream.normal()) << first + i;
    }
  }
}

TEST(AddressedNoise, DiffersInEveryPartOfTheAddress) {
  double const here = normal_at(key, NoiseStream::torque_white, 5);
  EXPECT_NE(here, normal_at(key, NoiseStream::torque_white, 6));
  EXPECT_NE(here, normal_at(key, NoiseStream::position, 5));
  EXPECT_NE(here, normal_at({11, 1, RandomDomain::simulation}, NoiseStream::torque_white, 5));
  EXPECT_NE(here, normal_at({12, 0, RandomDomain::simulation}, NoiseStream::torque_white, 5));
}

TEST(ColouredNoise, WhiteHasTheStandardDeviationAskedFor) {
  auto const values = drawn({key, NoiseStream::torque_white, 0.3, 0.0, 1000.0}, 100000);
  // standard error of a variance of n normals: sqrt(2 / n); five of them
  EXPECT_NEAR(autocovariance(values, 0), 0.09, 5.0 * 0.09 * std::sqrt(2.0 / 100000));
  EXPECT_NEAR(autocovariance(values, 1), 0.0, 5.0 * 0.09 / std::sqrt(100000.0));
}

TEST(ColouredNoise, CorrelationDecaysWithItsTime) {
  constexpr int n = 400000;
  auto const values = drawn({key, NoiseStream::torque_coloured, 2.0, 0.01, 1000.0}, n);
  // effective number of independent samples: n / (2 * 10 samples); five standard errors
  double const tolerance = 5.0 * 4.0 * std::sqrt(2.0 * 20.0 / n);
  EXPECT_NEAR(autocovariance(values, 0), 4.0, tolerance);
  EXPECT_NEAR(autocovariance(values, 10), 4.0 * std::exp(-1.0), tolerance);
  EXPECT_NEAR(autocovariance(values, 100), 0.0, tolerance);
}

TEST(ColouredNoise, IsStationaryFromTheFirstSample) {
  double sum = 0.0;
  constexpr int recordings = 20000;
  for (std::uint32_t run = 0; run < recordings; ++run) {
    ColouredNoise noise({1, run, RandomDomain::simulation}, NoiseStream::torque_coloured, 1.0, 1.0, 100.0);
    double const first = noise.next();
    sum += first * first;
  }
  EXPECT_NEAR(sum / recordings, 1.0, 5.0 * std::sqrt(2.0 / recordings));
}

}  // namespace noise_test
