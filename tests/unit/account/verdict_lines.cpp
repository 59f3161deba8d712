// A verdict in a few lines: names with numbers and intervals, errors over all samples.

#include "engine/account/verdict_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace torquescope {
namespace verdict_lines_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

NamedEffect effect_of(std::string const& name, std::string const& title) {
  NamedEffect effect;
  effect.name = name;
  effect.title = title;
  effect.p = 0.002;
  return effect;
}

JointDiagnosis joint_with(std::vector<NamedEffect> effects) {
  JointDiagnosis joint;
  joint.replicates = 200;
  joint.effects = std::move(effects);
  joint.train_relerr = 0.05;
  joint.augmented_train_relerr = 0.01;
  return joint;
}

TEST(VerdictLines, SayNumbersWithIntervalsAndShortTimesInMilliseconds) {
  NamedEffect late = effect_of("delay", "torque and position channel out of step");
  late.parameters = {{"delay", "s", 0.0038, 0.0031, 0.0044}};
  NamedEffect stribeck = effect_of("stribeck", "Stribeck friction: falls with speed just above rest");
  stribeck.parameters = {{"stribeck", "A", 0.35, 0.24, 0.46}, {"stribeck_speed", "rad/s", 0.08, 0.07, 0.09}};
  Diagnosis const diagnosis;
  VerdictLines const lines = verdict_lines(diagnosis, joint_with({stribeck, late}), Verdict::named);
  EXPECT_EQ(lines.what,
            "Stribeck friction 0.35 A [0.24, 0.46], speed 0.080 rad/s [0.070, 0.090]; "
            "delay 3.8 ms [3.1, 4.4], p < 0.005");
  EXPECT_EQ(lines.errors, "error, all samples: training 5.0 % -> 1.0 %");
}

TEST(VerdictLines, CountWavesInATurnAndSayNoIntervalThatDigitsHide) {
  NamedEffect cogging = effect_of("cogging", "cogging torque of the motor, fixed in the angle");
  cogging.parameters = {{"cogging", "N m", 0.06, 0.057, 0.062}, {"cogging_order", "1/rad", 12.0, 11.999, 12.001}};
  EXPECT_EQ(verdict_lines({}, joint_with({cogging}), Verdict::named).what,
            "cogging 0.060 N m [0.057, 0.062], 12 a turn, p < 0.005");
}

TEST(VerdictLines, TellTheAmplitudeOfAWaveWhereverItsZeroLies) {
  NamedEffect cogging = effect_of("cogging", "cogging torque of the motor, fixed in the angle");
  cogging.parameters = {{"cogging_cos", "N m", -0.03, -0.04, -0.02},
                        {"cogging_sin", "N m", 0.04, 0.03, 0.05},
                        {"cogging_order", "1/rad", 12.0, 11.999, 12.001}};
  EXPECT_EQ(verdict_lines({}, joint_with({cogging}), Verdict::named).what,
            "cogging 0.050 N m [0.040, 0.060], 12 a turn, p < 0.005");
  NamedEffect gravity = effect_of("gravity", "weight");
  gravity.parameters = {{"gravity_sin", "N m", 3.0}, {"gravity_cos", "N m", 4.0}};  // no interval is known
  EXPECT_EQ(verdict_lines({}, joint_with({gravity}), Verdict::named).what, "weight 5.0 N m, p < 0.005");
}

TEST(VerdictLines, ShowThreeMembersOfAClassAtMost) {
  NamedEffect one = effect_of("cogging", "cogging torque of the motor, fixed in the angle");
  one.parameters = {{"cogging_cos", "N m", 0.1}};
  one.equivalent = {"torque_ripple", "transmission_error", "spring", "cable"};
  VerdictLines const lines = verdict_lines({}, joint_with({one}), Verdict::one_of_class);
  EXPECT_THAT(lines.what, StartsWith("cogging 0.10 N m or torque ripple or transmission error or 2 more, p < 0.005"));
}

TEST(VerdictLines, PrintErrorsBeforeAndAfterWhereBothAreKnown) {
  JointDiagnosis joint = joint_with({effect_of("stribeck", "Stribeck friction")});
  joint.validation_relerr = 0.08;
  joint.augmented_validation_relerr = 0.02;
  EXPECT_EQ(verdict_lines({}, joint, Verdict::named).errors,
            "error, all samples: training 5.0 % -> 1.0 %, validation 8.0 % -> 2.0 %");
  joint.augmented_train_relerr = joint.validation_relerr = unknown;
  EXPECT_EQ(verdict_lines({}, joint, Verdict::named).errors, "error, all samples: training 5.0 %");
}

TEST(VerdictLines, OfADiagnosisThatWasGivenUpSayWhyAndNoError) {
  Diagnosis given_up;
  given_up.finding = "the joint stands still";
  VerdictLines const lines = verdict_lines(given_up, {}, Verdict::insufficient);
  EXPECT_EQ(lines.what, "the joint stands still");
  EXPECT_EQ(lines.errors, "");
}

TEST(VerdictLines, CallAResidualLikeReplicatesOnlyWhereTheyLeaveAsMuch) {
  JointDiagnosis joint = joint_with({});
  joint.omnibus_p = 0.3;
  EXPECT_THAT(verdict_lines({}, joint, Verdict::none).what, StartsWith("the residual is like that of 200 simulated"));
  joint.omnibus_p = 0.021;
  EXPECT_EQ(verdict_lines({}, joint, Verdict::none).what,
            "the residual differs from that of 200 simulated replicates (p = 0.021) by too little for a name");
}

TEST(VerdictLines, TellAJointOfAnArmItsOwnFault) {
  Diagnosis arm;
  arm.finding = "joint 1 stands still";
  arm.joints = {joint_with({}), joint_with({})};
  arm.joints[1].reason = "The torque of joint 2 does not move.";
  EXPECT_EQ(verdict_lines(arm, arm.joints[1], Verdict::data_fault).what, "The torque of joint 2 does not move");
}

TEST(VerdictLines, NameThreeEffectsWithOneNumberEachAndCountTheRest) {
  std::vector<NamedEffect> four;
  for (char const* const name : {"stribeck", "cogging", "spring", "backlash"}) {
    four.push_back(effect_of(name, name));
    four.back().parameters = {{name, "N m", 0.1}, {"shape", "rad", 2.0}};
  }
  EXPECT_EQ(verdict_lines({}, joint_with(four), Verdict::named).what,
            "stribeck 0.10 N m; cogging 0.10 N m; spring 0.10 N m, p < 0.005; and 1 more");
}

TEST(VerdictLines, SayWhatWasDoneToAChannelAndThatAValidationIsOfAnotherKind) {
  JointDiagnosis joint = joint_with({});
  joint.timing_sentence = "The torque was moved by 2 ms.";
  joint.validation_relerr = 0.4;
  joint.augmented_train_relerr = unknown;
  auto const remarks = verdict_lines({}, joint, Verdict::none).remarks;
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_EQ(remarks[0], "The torque was moved by 2 ms.");
  EXPECT_THAT(remarks[1], HasSubstr("40.0 % there, 5.0 % here"));
}

TEST(Headline, OfAnArmNamesTheJointsThatLackSomething) {
  Diagnosis arm;
  arm.joints = {joint_with({}), joint_with({effect_of("stribeck", "Stribeck friction: falls with speed")}),
                joint_with({})};
  for (int j = 0; j < 3; ++j) arm.joints[static_cast<std::size_t>(j)].joint = j + 1;
  EXPECT_EQ(headline_of(arm), "no joint lacks anything");
  arm.joints[1].verdict = Verdict::named;
  arm.joints[2].verdict = Verdict::unexplained;
  EXPECT_EQ(headline_of(arm), "joint 2: Stribeck friction; joint 3: unexplained");
}

TEST(VerdictLines, SumAnArmOverItsJointsByTheEnergyOfTheirTorques) {
  Diagnosis diagnosis;
  for (double const error : {0.3, 0.1}) {
    JointDiagnosis joint = joint_with({});
    joint.validation_relerr = error;
    joint.augmented_validation_relerr = 0.5 * error;
    joint.validation_torque_energy = error > 0.2 ? 1.0 : 8.0;
    diagnosis.joints.push_back(joint);
  }
  // sqrt((1 * 0.09 + 8 * 0.01) / 9) = 0.1374
  EXPECT_THAT(arm_lines(diagnosis).errors, StartsWith("error, all joints and samples: validation 13.7 % -> 6.9 %"));
  // forces and torques have no common energy: sqrt((0.09 + 0.01) / 2) = 0.2236
  diagnosis.joints[0].unit_torque = "N";
  EXPECT_EQ(arm_lines(diagnosis).errors, "error, all samples, mean of the joints: validation 22.4 % -> 11.2 %");
}

}  // namespace verdict_lines_test
}  // namespace torquescope
