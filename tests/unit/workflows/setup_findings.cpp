// The lines that an arm's job needs for another set-up: all numbers, beside the keys that it has already.

#include "engine/experiment/setup_findings.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace setup_findings_test {

using enum SetupKind;

SerialChain arm() {
  SerialChain chain;
  chain.joints.resize(3);
  return chain;
}

std::string lines(std::vector<SetupChange> const& changes, RecordingOptions const& options = {}) {
  SerialChain const chain = arm();
  ArmSetup setup = setup_as_read(chain);
  for (auto const& change : changes) setup = changed(std::move(setup), change, chain);
  return setup_lines(setup, chain, options, "modified_dh");
}

TEST(SetupLines, NameOneKeyForEachChange) {
  EXPECT_EQ(lines({}), "");
  EXPECT_EQ(lines({{joint_sign, 1}}), "joint_sign = [1, -1, 1]");
  EXPECT_EQ(lines({{torque_sign, 2}}), "torque_per_unit = [1, 1, -1]");
  EXPECT_EQ(lines({{position_sign, 0}}), "joint_sign = [-1, 1, 1]   torque_per_unit = [-1, 1, 1]");
  EXPECT_EQ(lines({{positions_exchanged, 0, 2}}), "position_order = [3, 2, 1]");
  EXPECT_EQ(lines({{torques_exchanged, 0, 1}}), "torque_order = [2, 1, 3]");
  EXPECT_EQ(lines({{joints_exchanged, 1, 2}}), "position_order = [1, 3, 2]   torque_order = [1, 3, 2]");
  EXPECT_EQ(lines({{zero, 1, -1, -0.25}}), "zero = [0, -0.25, 0]");
  EXPECT_EQ(lines({{torque_factor, 2, -1, 50.0}}), "torque_per_unit = [1, 1, 50]");
  EXPECT_EQ(lines({{position_factor, -1, -1, 0.5}}), "position_per_unit = 0.5");
  EXPECT_EQ(lines({{no_gravity}}), "[model] gravity = [0, 0, 0]");
  EXPECT_EQ(lines({{dh_convention}}), "convention = \"modified_dh\" in [robot] of the robot file");
}

TEST(SetupLines, ComposeChanges) {
  EXPECT_EQ(lines({{joint_sign, 1}, {torque_factor, 1, -1, 20.0}}),
            "joint_sign = [1, -1, 1]   torque_per_unit = [1, 20, 1]");
  EXPECT_EQ(lines({{joint_sign, 1}, {torque_sign, 1}}), "joint_sign = [1, -1, 1]   torque_per_unit = [1, -1, 1]");
  EXPECT_EQ(lines({{joint_sign, 1}, {joint_sign, 1}}), "");
  EXPECT_EQ(lines({{zero, 0, -1, 0.5}, {positions_exchanged, 0, 1}}),
            "position_order = [2, 1, 3]   zero = [0.5, 0, 0]");
}

TEST(SetupLines, KeepWhatTheJobSaysAlready) {
  RecordingOptions options;
  options.joint_sign = {1.0, -1.0, 1.0};
  options.zero = {0.1, 0.2, 0.3};
  options.torque_per_unit = {2.0, 3.0, 4.0};
  options.delay_s = {0.0, 0.01, 0.02};
  EXPECT_EQ(lines({{torque_sign, 1}}, options), "torque_per_unit = [2, -3, 4]");
  EXPECT_EQ(lines({{joint_sign, 1}}, options), "joint_sign = [1, 1, 1]   zero = [0.1, -0.2, 0.3]");
  EXPECT_EQ(lines({{zero, 2, -1, 0.5}}, options), "zero = [0.1, 0.2, 0.8]");
  EXPECT_EQ(lines({{torques_exchanged, 0, 2}}, options),
            "torque_order = [3, 2, 1]   torque_per_unit = [4, 3, 2]   delay_s = [0.02, 0.01, 0]");
  options.position_order = {2.0, 1.0, 3.0};
  EXPECT_EQ(lines({{positions_exchanged, 0, 1}}, options),
            "position_order = [1, 2, 3]   joint_sign = [-1, 1, 1]   zero = [0.2, 0.1, 0.3]   "
            "torque_per_unit = [-2, -3, 4]");
}

}  // namespace setup_findings_test
}  // namespace torquescope
