// diagnose.effects of a set of servos: all effects of drive and gear, or those named, and refusals.

#include "engine/experiment/servo_effects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace torquescope {
namespace servo_effects_test {

using ::testing::HasSubstr;
using ::testing::SizeIs;

struct Asked {
  ServoEffects effects{};
  std::vector<Problem> problems{};
};

Asked asked_for(std::vector<std::string> const& effects) {
  DiagnoseOptions options;
  options.effects = effects;
  Regressor const regressor({"inertia", "viscous", "coulomb"}, JointKind::revolute);
  Asked asked;
  asked.effects = servo_effects(options, regressor, Section{}, asked.problems);
  return asked;
}

TEST(ServoEffects, AllAreThoseOfDriveAndGear) {
  Asked const asked = asked_for({"all"});
  EXPECT_THAT(asked.problems, SizeIs(0));
  EXPECT_EQ(asked.effects.of_drive.size(), drive_effects().size());
  EXPECT_THAT(asked.effects.of_joint, SizeIs(0));
}

TEST(ServoEffects, NamesAreEffectsOfTheDriveOrEffectsOfTheJoint) {
  Asked const asked = asked_for({"punch", "cogging", "angle_friction"});
  EXPECT_THAT(asked.problems, SizeIs(0));
  ASSERT_THAT(asked.effects.of_drive, SizeIs(2));
  EXPECT_STREQ(asked.effects.of_drive[0]->name, "punch");
  EXPECT_STREQ(asked.effects.of_drive[1]->name, "angle_friction");
  ASSERT_THAT(asked.effects.of_joint, SizeIs(1));
  EXPECT_EQ(asked.effects.of_joint[0]->name(), "cogging");
}

TEST(ServoEffects, RefusesWhatNoServoCanBeAskedFor) {
  Asked const unknown = asked_for({"load_frictoin"});
  ASSERT_THAT(unknown.problems, SizeIs(1));
  EXPECT_THAT(unknown.problems[0].caret_note, HasSubstr("load_friction"));
  EXPECT_THAT(asked_for({"viscous"}).problems, SizeIs(1));
  EXPECT_THAT(asked_for({"delay"}).problems, SizeIs(1));
  EXPECT_THAT(asked_for({"punch", "punch"}).problems, SizeIs(2));
  EXPECT_THAT(asked_for({"punch", "all"}).problems, SizeIs(1));
}

}  // namespace servo_effects_test
}  // namespace torquescope
