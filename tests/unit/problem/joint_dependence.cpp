// Rows of an arm that are left out: those of the joints that need what is missing, and no others.

#include "engine/fit/problem/joint_dependence.hpp"

#include <gmock/gmock.h>

#include "unit/problem/arm_data.hpp"

namespace torquescope {
namespace joint_dependence_test {

using namespace test;

using testing::ElementsAre;

// three slides at right angles to each other
SerialChain gantry() {
  constexpr double quarter = 1.5707963267948966;
  SerialChain chain;
  chain.gravity = {0.0, 0.0, -9.81};
  for (int j = 0; j < 3; ++j) {
    ChainJoint joint;
    joint.name = "axis" + std::to_string(j + 1);
    joint.kind = JointKind::prismatic;
    joint.alpha = j == 0 ? 0.0 : quarter;
    joint.offset = j == 0 ? 0.0 : quarter;
    chain.joints.push_back(joint);
    chain.links.emplace_back();
  }
  return chain;
}

TEST(MotionDependence, EveryJointOfASerialArmFeelsAllOthers) {
  auto const depends = motion_dependence(crs());
  for (std::size_t j = 1; j < 5; ++j)
    for (std::size_t k = 0; k < 5; ++k) EXPECT_TRUE(depends[j][k]) << j << " " << k;
}

TEST(MotionDependence, SlidesAtRightAnglesDoNotFeelEachOther) {
  ArmModel const model(gantry(), ArmTerms{friction}, Section{"model", {}, {}});
  auto const depends = motion_dependence(model);
  EXPECT_THAT(depends[0], ElementsAre(true, false, false));
  EXPECT_THAT(depends[1], ElementsAre(false, true, false));
  EXPECT_THAT(depends[2], ElementsAre(false, false, true));
}

std::vector<Motion> with_stretch(std::size_t joint, bool of_motion) {
  auto motion = motion_of(5, 900, 3);
  LeftOutStretch const stretch{{4.0, 6.0}, LeftOutReason::no_value, "q", of_motion};
  motion[joint].left_out = {stretch.where};
  motion[joint].left_out_because = {stretch};
  return motion;
}

TEST(RecordedRows, AMissingTorqueTakesOutTheRowsOfItsJointAlone) {
  auto const model = crs();
  auto const rows = rows_of(model, with_stretch(2, false));
  for (std::size_t j = 0; j < 5; ++j) EXPECT_EQ(rows.moving[j].torque.size(), j == 2 ? 900 - 101 : 900) << j;
}

TEST(RecordedRows, AFrozenEncoderTakesOutTheRowsOfAllJointsThatFeelIt) {
  auto const model = crs();
  auto const rows = rows_of(model, with_stretch(2, true));
  auto const depends = motion_dependence(model);
  for (std::size_t j = 0; j < 5; ++j) {
    EXPECT_EQ(rows.moving[j].torque.size(), depends[j][2] ? 900 - 101 : 900) << j;
    EXPECT_DOUBLE_EQ(rows.accounts[j].read, 900);
    EXPECT_DOUBLE_EQ(rows.accounts[j].used(), static_cast<double>(rows.moving[j].torque.size()));
    if (!depends[j][2]) continue;
    EXPECT_EQ(rows.accounts[j].parts.front().column, "q");
  }
}

}  // namespace joint_dependence_test
}  // namespace torquescope
