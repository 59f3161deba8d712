// Which laws are asked whether they can be told from an accepted one.

#include "engine/infer/moving_rows/confidence_set.hpp"

#include <gtest/gtest.h>

using namespace torquescope;

namespace confidence_set_test {

EffectScan scanned(double gain, double p, bool is_testable = true) {
  EffectScan scan;
  scan.gain = gain;
  scan.p = p;
  scan.is_testable = is_testable;
  return scan;
}

TEST(ConfidenceSet, AsksLawsBeyondChanceAndThoseThatGainNoLess) {
  constexpr double own_gain = 2.0, alpha = 0.05;
  EXPECT_TRUE(may_be_a_rival(scanned(0.5, 0.01), own_gain, alpha)) << "beyond chance";
  EXPECT_TRUE(may_be_a_rival(scanned(6.0, 0.2), own_gain, alpha)) << "searched over more shapes, yet it fits better";
  EXPECT_FALSE(may_be_a_rival(scanned(0.5, 0.2), own_gain, alpha)) << "chance, and fits worse";
  EXPECT_FALSE(may_be_a_rival(scanned(0.0, 0.01), own_gain, alpha)) << "the signs of physics leave nothing of it";
  EXPECT_FALSE(may_be_a_rival(scanned(6.0, 0.01, false), own_gain, alpha)) << "the model's own columns explain it";
}

}  // namespace confidence_set_test
