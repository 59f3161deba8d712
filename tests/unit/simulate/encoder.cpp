#include "engine/simulate/encoder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace torquescope;

TEST(Encoder, IsOffByAtMostHalfAStep) {
  EncoderOptions options;
  options.counts_per_revolution = 4096;
  Encoder const encoder(options);
  EXPECT_DOUBLE_EQ(encoder.step(), 2.0 * std::numbers::pi / 4096);
  double largest = 0.0;
  for (int i = -5000; i < 5000; ++i) {
    double const q = 0.000317 * i;
    largest = std::max(largest, std::abs(encoder.read(q) - q));
  }
  EXPECT_LE(largest, 0.5 * encoder.step() * (1.0 + 1e-9));
  EXPECT_GT(largest, 0.49 * encoder.step());
}

TEST(Encoder, ShowsWholeStepsOnly) {
  EncoderOptions options;
  options.step = 0.01;
  Encoder const encoder(options);
  EXPECT_DOUBLE_EQ(encoder.read(0.1234), 0.12);
  EXPECT_DOUBLE_EQ(encoder.read(-0.1261), -0.13);
  EXPECT_EQ(encoder.read(encoder.read(0.777)), encoder.read(0.777));
}

TEST(Encoder, IsExactWithoutAStep) { EXPECT_EQ(Encoder(EncoderOptions{}).read(0.1234567), 0.1234567); }
