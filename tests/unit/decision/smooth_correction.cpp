// What one recording has and another has not stands out by a smooth function of that recording alone.

#include "engine/infer/decision/smooth_correction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/decision/largest_correction.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace smooth_correction_test {

// of two recordings, the second of which may have an effect of its own
LargestCorrection found(std::function<double(double q, double dq)> const& in_second) {
  GivenJoint joint;
  std::vector<Recording> training{recording_of(joint)};
  joint.pace = 0.87;
  joint.seed = 2;
  joint.effect = in_second;
  training.push_back(recording_of(joint));
  return largest_correction(training);
}

TEST(SmoothCorrection, SeesWhatOneOfTwoRecordingsHas) {
  LargestCorrection const sound = found({}), sprung = found([](double q, double) { return 0.3 * std::sin(3.0 * q); });
  EXPECT_EQ(sprung.axis, SignatureAxis::position);
  EXPECT_GT(sprung.gain, 5.0 * sound.gain);
  EXPECT_GT(sprung.rms, 0.1);
}

}  // namespace smooth_correction_test
