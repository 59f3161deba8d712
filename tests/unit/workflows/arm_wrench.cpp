// Columns of a wrench as torque of the joints, and what is refused.

#include "engine/experiment/arm_wrench.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/robot/tip_wrench.hpp"

namespace torquescope {
namespace arm_wrench_test {

SerialChain two_joints() {
  SerialChain chain;
  chain.joints.resize(2);
  chain.joints[1].a = 0.5;
  chain.flange.position = {0.3, 0.0, 0.0};
  return chain;
}

RecordedArm pushed_arm() {
  RecordedArm arm;
  for (double const position : {0.2, -0.4}) {
    Recording joint;
    joint.position = Eigen::VectorXd::Constant(3, position);
    joint.torque = Eigen::VectorXd::Ones(3);
    arm.joints.push_back(joint);
  }
  for (int k = 0; k < 6; ++k) {
    Recording column;
    column.external_torque = Eigen::VectorXd::Constant(3, k + 1.0);
    arm.wrench.push_back(column);
  }
  arm.wrench[2].left_out_because = {{{0.5, 0.7}, LeftOutReason::no_value, "fz"}};
  return arm;
}

TEST(ArmWrench, IsATorqueOfEachJoint) {
  RecordingOptions options;
  for (auto const* side : {"arm", "surroundings"}) {
    options.wrench_on = side;
    RecordedArm arm = pushed_arm();
    add_wrench(arm, two_joints(), options);
    double const sign = options.wrench_on == "arm" ? 1.0 : -1.0;
    // fy at 0.3 m, mz
    EXPECT_NEAR(arm.joints[1].torque[0], 1.0 + sign * (0.3 * 2.0 + 6.0), 1e-12);
    EXPECT_NEAR(arm.outside.as_read(0, 1), sign * (0.3 * 2.0 + 6.0), 1e-12);
    EXPECT_NE(arm.outside.as_read(0, 0), arm.outside.otherwise(0, 0));
  }
}

TEST(ArmWrench, WithoutAValueLeavesOutEveryJoint) {
  RecordedArm arm = pushed_arm();
  add_wrench(arm, two_joints(), {});
  for (auto const& joint : arm.joints) {
    ASSERT_EQ(joint.left_out_because.size(), 1u);
    EXPECT_FALSE(joint.left_out_because[0].of_motion);
    EXPECT_EQ(joint.left_out.size(), 1u);
  }
}

std::vector<std::string> refused(RecordingOptions const& options, std::string const& text, bool has_gains) {
  std::vector<Problem> problems;
  check_wrench(parse_job(text, "arm.toml"), options, {}, has_gains, problems);
  std::vector<std::string> said;
  for (auto const& problem : problems) said.push_back(problem.what);
  return said;
}

TEST(ArmWrench, NeedsSixColumnsAndTheMotorsOwnGains) {
  RecordingOptions options;
  EXPECT_THAT(refused(options, "[recording]\nwrench_on = \"arm\"\n", false),
              testing::ElementsAre("wrench_on without wrench"));
  options.wrench = {"fx", "fy", "fz"};
  EXPECT_THAT(refused(options, "", false), testing::ElementsAre("wrench has 3 columns, not 6"));
  options.wrench = {"fx", "fy", "fz", "mx", "my", "mz"};
  EXPECT_TRUE(refused(options, "", false).empty());
  EXPECT_THAT(refused(options, "", true), testing::ElementsAre(testing::HasSubstr("drive_gains beside")));
}

}  // namespace arm_wrench_test
}  // namespace torquescope
