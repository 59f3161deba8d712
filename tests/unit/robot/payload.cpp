// What an arm carries: which of its numbers are parameters, and where its centre lies.

#include "engine/robot/payload.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace payload_test {

// with its mass unknown, all of it is a parameter and nothing is known
TEST(Payload, OfUnknownMassHasTenNumbers) {
  SerialChain const chain = test::ur10e();
  BaseParameters const base(chain, DriveInertias::included);
  PayloadColumns const columns = payload_columns(chain, base, {});
  ASSERT_EQ(columns.names.size(), 10u);
  EXPECT_EQ(columns.names.front(), "m6");
  EXPECT_EQ(columns.units.front(), "kg");
  EXPECT_EQ(columns.units[1], "kg m");
  EXPECT_EQ(columns.units[9], "kg m^2");
  EXPECT_EQ(columns.known.norm(), 0.0);
  EXPECT_FALSE(columns.tells_scale);
  EXPECT_EQ(payload_columns(chain, base, {2.0}).names.front(), "mx6");
}

TEST(Payload, HasItsCentreInTheFrameOfTheTip) {
  SerialChain chain = test::ur10e();
  chain.flange.position = {0.1, 0.0, 0.2};
  chain.flange.rotation << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  Eigen::Vector4d const numbers(2.0, 0.6, 0.2, 1.0);  // centre 0.3, 0.1, 0.5 of the last link
  Eigen::Matrix4d covariance = Eigen::Vector4d(0.04, 0.01, 0.0, 0.0).asDiagonal();
  PayloadCentre const found = payload_centre(chain, numbers, covariance);
  EXPECT_EQ(found.mass_kg, 2.0);
  EXPECT_NEAR(found.mass_error, 0.2, 1e-12);
  EXPECT_LT((found.centre_m - Eigen::Vector3d(0.1, -0.2, 0.3)).norm(), 1e-12);
  // d(h / m) = dh / m - h dm / m^2; the tip's y lies against the link's x
  EXPECT_NEAR(found.centre_error.y(), std::hypot(0.1 / 2.0, 0.3 * 0.2 / 2.0), 1e-12);
  EXPECT_NEAR(found.centre_error.x(), 0.1 * 0.2 / 2.0, 1e-12);
}

}  // namespace payload_test
}  // namespace torquescope
