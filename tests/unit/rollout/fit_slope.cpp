// Forward differences of a fit find the slope that central ones find, with half the simulations, and keep the bounds.

#include "engine/simulate/rollout/fit_slope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/rollout/recorded_joints.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace fit_slope_test {

constexpr CountedChannels both{true, true};
constexpr ChannelNumbers effective{500.0, 900.0};

struct PdJoint {
  PlainJoint joint = dry_joint();
  PlainController controller = controller_of("pd");
  std::vector<RolloutTrack> tracks{recorded(joint, controller, moved(1500), {})};
  RolloutModel model{Regressor(joint_terms(), JointKind::revolute),
                     truth_of(joint),
                     scales_of(tracks[0], joint),
                     {},
                     free_loop(controller, tracks)};
  FitUnknowns unknowns{model, tracks, both, true};
};

TEST(FitSlope, OfForwardDifferencesIsThatOfCentralOnes) {
  PdJoint const one;
  FitPoint const at = one.unknowns.begin_at(one.model.start());
  FitSlope const central = slope_at(one.unknowns, at, effective, 2e-3, Differences::central, 1);
  FitSlope const forward = slope_at(one.unknowns, at, effective, 2e-3, Differences::forward, 1);
  ASSERT_EQ(central.curvature.rows(), one.unknowns.size());
  for (Eigen::Index k = 0; k < central.curvature.rows(); ++k) {
    ASSERT_GT(central.curvature(k, k), 0.0);
    // an error of the width; where a joint begins decides which way dry friction points there
    double const width_error = k < one.unknowns.parameters() ? 0.05 : 0.3;
    EXPECT_NEAR(forward.curvature(k, k) / central.curvature(k, k), 1.0, width_error) << k;
    double const largest = std::sqrt(central.curvature(k, k) * (effective[0] + effective[1]));
    EXPECT_NEAR(forward.descent[k], central.descent[k], 0.03 * largest) << k;
  }
}

// a gain of zero cannot be less: both kinds take the same step
TEST(FitSlope, StaysWithinBounds) {
  PdJoint const one;
  FitPoint at = one.unknowns.begin_at(one.model.start());
  auto const last = static_cast<Eigen::Index>(one.model.size()) - 1;
  at[last] = one.model.parameters()[static_cast<std::size_t>(last)].lower;
  ASSERT_EQ(at[last], 0.0);
  FitSlope const forward = slope_at(one.unknowns, at, effective, 2e-3, Differences::forward, 1);
  FitSlope const central = slope_at(one.unknowns, at, effective, 2e-3, Differences::central, 1);
  EXPECT_GT(central.curvature(last, last), 0.0);
  EXPECT_EQ(forward.curvature(last, last), central.curvature(last, last));
  EXPECT_EQ(forward.descent[last], central.descent[last]);
}

}  // namespace fit_slope_test
