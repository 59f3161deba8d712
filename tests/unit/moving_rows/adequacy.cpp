// Where what a model leaves lies among what its replicates leave.

#include "engine/infer/moving_rows/adequacy.hpp"

#include <gtest/gtest.h>

using namespace torquescope;

namespace adequacy_test {

// recording first, then replicates at 1.00, 1.01, ... 1.98
Eigen::VectorXd left_by(double recording) {
  Eigen::VectorXd left(100);
  left[0] = recording;
  for (Eigen::Index t = 1; t < left.size(); ++t) left[t] = 1.0 + 0.01 * static_cast<double>(t - 1);
  return left;
}

TEST(Adequacy, HoldsAmongTheReplicates) {
  AdequacyPart const part = adequacy_part(left_by(1.5), 0.0, 1e3, {});
  EXPECT_TRUE(part.holds);
  EXPECT_NEAR(part.p, 0.5, 0.02);
}

TEST(Adequacy, FailsBeyondThemUnlessTheExcessIsSmallBesideTheTorque) {
  EXPECT_FALSE(adequacy_part(left_by(3.0), 0.0, 1e3, {}).holds);
  // an excess of 1.5 in a torque of 1e6: 0.12 % of its rms
  AdequacyPart const small = adequacy_part(left_by(3.0), 0.0, 1e6, {});
  EXPECT_TRUE(small.holds);
  EXPECT_NEAR(small.excess_share, std::sqrt(1.51e-6), 1e-5);
  EXPECT_DOUBLE_EQ(small.p, 0.01);
}

TEST(Adequacy, AllowsTheFormOfALawToBeOff) {
  EXPECT_FALSE(adequacy_part(left_by(3.0), 0.5, 1e3, {}).holds);
  EXPECT_TRUE(adequacy_part(left_by(3.0), 1.5, 1e3, {}).holds);
}

}  // namespace adequacy_test
