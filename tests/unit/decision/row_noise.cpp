// Noise of rows has the powers that it was asked for, and no wave of its own.

#include "engine/infer/decision/row_noise.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "engine/base/random_stream.hpp"

using namespace torquescope;

namespace row_noise_test {

constexpr std::uint32_t draws = 400;

OctavePowers mean_drawn(OctavePowers const& powers, Eigen::Index n) {
  std::vector<OctavePowers> all;
  for (std::uint32_t t = 0; t < draws; ++t) all.push_back(octave_powers(drawn_noise(powers, n, {7, 0, t})));
  return mean_of(all);
}

Eigen::VectorXd sine(Eigen::Index n, double size, double waves) {
  Eigen::VectorXd signal(n);
  for (Eigen::Index k = 0; k < n; ++k)
    signal[k] = size * std::sin(2.0 * std::numbers::pi * waves * static_cast<double>(k) / static_cast<double>(n) + 0.3);
  return signal;
}

// 256 rows have bands of waves [1, 4), [4, 16), [16, 64) and [64, 128)
TEST(RowNoise, HasThePowersThatAreAsked) {
  for (Eigen::Index const n : {256, 200})
    for (double const fall : {1.0, 2.0, 0.5}) {
      OctavePowers asked{Eigen::VectorXd(4)};
      for (Eigen::Index b = 0; b < 4; ++b) asked.per_wave[b] = 0.3 * std::pow(fall, -static_cast<double>(b));
      OctavePowers const drawn = mean_drawn(asked, n);
      ASSERT_EQ(drawn.per_wave.size(), 4);
      for (Eigen::Index b = 0; b < 4; ++b) EXPECT_NEAR(drawn.per_wave[b] / asked.per_wave[b], 1.0, 0.2) << n << fall;
    }
}

TEST(RowNoise, PowersOfAllWavesAreTheMeanSquare) {
  OctavePowers const flat{Eigen::VectorXd::Constant(4, 0.5)};
  double square = 0.0;
  for (std::uint32_t t = 0; t < draws; ++t) square += drawn_noise(flat, 256, {3, 0, t}).squaredNorm() / 256.0 / draws;
  EXPECT_NEAR(square, 2.0 * 127.0 * 0.5, 0.05 * 127.0);
  // white noise of deviation 2, zeros behind it
  double power = 0.0;
  for (std::uint32_t t = 0; t < draws; ++t) {
    RandomStream random({1, 0, RandomDomain::test}, 0, t);
    Eigen::VectorXd signal(200);
    for (double& one : signal) one = 2.0 * random.normal();
    power += octave_powers(signal).per_wave[2] / draws;
  }
  EXPECT_NEAR(power * 256.0, 4.0, 0.2);
}

TEST(RowNoise, IsTheSameAtTheSameAddressAlone) {
  OctavePowers const flat{Eigen::VectorXd::Ones(4)};
  NoiseAddress const address{5, 2, 9};
  Eigen::VectorXd const noise = drawn_noise(flat, 200, address);
  EXPECT_EQ(noise, drawn_noise(flat, 200, address));
  for (NoiseAddress const other : {NoiseAddress{6, 2, 9}, NoiseAddress{5, 3, 9}, NoiseAddress{5, 2, 10}}) {
    Eigen::VectorXd const another = drawn_noise(flat, 200, other);
    EXPECT_LT(std::abs(noise.dot(another)), 0.3 * noise.norm() * another.norm());
  }
}

TEST(RowNoise, SpreadsASineOverItsBand) {
  constexpr double size = 2.0, band_waves = 48.0;
  constexpr Eigen::Index n = 256;
  OctavePowers const powers = octave_powers(sine(n, size, 20.0));
  double const per_wave = 0.25 * size * size / band_waves;
  EXPECT_NEAR(powers.per_wave[2], per_wave, 1e-9);
  for (Eigen::Index const band : {0, 1, 3}) EXPECT_NEAR(powers.per_wave[band], 0.0, 1e-9);
  // every wave of the band holds as much as the sine's own; exactly zero beside it, as less() makes it
  OctavePowers clean = powers;
  for (Eigen::Index const band : {0, 1, 3}) clean.per_wave[band] = 0.0;
  Eigen::VectorXd wave = Eigen::VectorXd::Zero(n / 2);
  for (std::uint32_t t = 0; t < draws; ++t) {
    Eigen::VectorXd const noise = drawn_noise(clean, n, {11, 0, t});
    for (Eigen::Index k = 1; k < n / 2; ++k) {
      std::complex<double> sum = 0.0;
      for (Eigen::Index i = 0; i < n; ++i)
        sum += noise[i] * std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(k * i % n) / n);
      wave[k] += std::norm(sum) / (n * n * static_cast<double>(draws));
    }
  }
  for (Eigen::Index k = 1; k < n / 2; ++k) EXPECT_NEAR(wave[k], k >= 16 && k < 64 ? per_wave : 0.0, 0.25 * per_wave);
}

TEST(RowNoise, WhatReplicatesHaveAlreadyIsTakenOff) {
  OctavePowers const whole{Eigen::Vector3d(3.0, 2.0, 1.0)}, part{Eigen::Vector3d(1.0, 2.5, 0.25)};
  EXPECT_EQ(less(whole, part).per_wave, Eigen::VectorXd(Eigen::Vector3d(2.0, 0.0, 0.75)));
  EXPECT_EQ(mean_of({whole, part}).per_wave, Eigen::VectorXd(Eigen::Vector3d(2.0, 2.25, 0.625)));
}

}  // namespace row_noise_test
