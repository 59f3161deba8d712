// What a person is told: what is missing, where, how much, how sure and what it buys, worded by what an effect is.

#include "engine/account/sentences.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "engine/effects/effect.hpp"
#include "support/example_diagnosis.hpp"

namespace torquescope {
namespace sentences_test {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

JointDiagnosis joint_of_two_hundred_replicates() {
  JointDiagnosis joint;
  joint.unit_position = "rad";
  joint.unit_torque = "N m";
  joint.replicates = 200;
  return joint;
}

// an effect of the catalogue with all parameters at one value
NamedEffect effect_of(Effect const& effect, double value) {
  NamedEffect named;
  named.name = effect.name();
  named.family = word(effect.family());
  named.title = effect.title();
  named.acts_on = word(effect.acts_on());
  named.p = 1.0 / 201.0;
  named.peak = 0.21;
  for (auto const& parameter : effect.parameters())
    named.parameters.push_back({parameter.name, parameter.unit_revolute, value, value, value});
  return named;
}

TEST(ReasonSentence, IsTheOneOfTheSpecification) {
  Diagnosis diagnosis = example::invented_diagnosis();
  diagnosis.joints[0].effects.resize(1);
  EXPECT_EQ(
      reason_sentence(diagnosis),
      "Joint 1 loses 0.35 N m extra below 0.12 rad/s in both directions: Stribeck friction (p < 0.005; presliding "
      "cannot be excluded). Validation error 12.1 % to 6.2 %.");
}

TEST(ReasonSentence, CallsTheJointByItsColumn) {
  Diagnosis diagnosis = example::invented_diagnosis();
  diagnosis.joints[0].name = "q5_rad";
  EXPECT_THAT(reason_sentence(diagnosis), StartsWith("The joint of q5_rad loses 0.35 N m extra"));
  EXPECT_THAT(reason_sentence(diagnosis), Not(HasSubstr("oint 1")));
  for (auto diagnosed : {example::invented_none(), example::invented_unexplained(), example::invented_class()}) {
    diagnosed.joints[0].name = "q5_rad";
    EXPECT_THAT(reason_sentence(diagnosed), AllOf(HasSubstr("joint of q5_rad"), Not(HasSubstr("oint 1"))));
  }
}

TEST(ReasonSentence, TellsTwoEffectsAndNamesTheOthers) {
  Diagnosis diagnosis = example::invented_diagnosis();
  EXPECT_THAT(reason_sentence(diagnosis),
              HasSubstr("Joint 1 deviates by up to 0.060 N m from the model around 12 waves "
                        "per turn: cogging torque of the motor (p < 0.005)."));
  diagnosis.joints[0].effects.push_back(effect_of(*find_effect("thermal_friction"), 0.1));
  EXPECT_THAT(reason_sentence(diagnosis), HasSubstr("Also named: thermal friction."));
}

TEST(ReasonSentence, SaysThatTheMotionCannotTellAClassApart) {
  EXPECT_THAT(reason_sentence(example::invented_class()),
              HasSubstr(": stribeck or presliding (p < 0.005; this motion cannot tell which)."));
}

TEST(ReasonSentence, SaysWhatIsLeftWhenMuchIsLeft) {
  Diagnosis diagnosis = example::invented_diagnosis();
  EXPECT_THAT(reason_sentence(diagnosis), Not(HasSubstr("unexplained")));
  diagnosis.joints[0].budget.unexplained = 0.124;
  EXPECT_THAT(reason_sentence(diagnosis), HasSubstr("12.4 % of the mismatch's energy stays unexplained."));
}

TEST(ReasonSentence, UsesCrossValidationAndSaysSoWithoutAnValidationRecording) {
  Diagnosis diagnosis = example::invented_diagnosis();
  diagnosis.joints[0].validation_relerr = unknown;
  EXPECT_THAT(reason_sentence(diagnosis), HasSubstr("Cross-validated error 12.0 % to 6.2 %"));
  EXPECT_THAT(reason_sentence(diagnosis), Not(HasSubstr("Unseen")));
}

TEST(ReasonSentence, OfNothingMissingStatesThePowerOnlyWhereItIsKnown) {
  Diagnosis diagnosis = example::invented_none();
  EXPECT_EQ(reason_sentence(diagnosis),
            "The residual of joint 1 looks like that of 200 simulated replicates (p = 0.41). A 5 % Stribeck effect "
            "would have "
            "shown.");
  diagnosis.joints[0].power_sentence.clear();
  EXPECT_EQ(reason_sentence(diagnosis),
            "The residual of joint 1 looks like that of 200 simulated replicates (p = 0.41).");
}

TEST(ReasonSentence, LeavesTheNameOfAFileAsItIs) {
  Diagnosis diagnosis = example::invented_insufficient();
  diagnosis.finding = "train.csv: only one direction of motion was recorded";
  EXPECT_THAT(reason_sentence(diagnosis), StartsWith("train.csv: only one"));
}

TEST(ReasonSentence, OfSomethingElseSaysWhereItIsAndThatNothingFits) {
  EXPECT_EQ(reason_sentence(example::invented_unexplained()),
            "31.0 % of the residual of joint 1 lies between 0.40 and 0.90 rad, more than simulated replicates have "
            "there, but none of "
            "34 known effects fits it.");
}

TEST(ReasonSentence, OfABadRecordingEndsWithTheWayOut) {
  EXPECT_EQ(reason_sentence(example::invented_insufficient()),
            "Only one direction of motion was recorded. Viscous and coulomb cannot be told apart. Record both "
            "directions.");
  EXPECT_EQ(
      reason_sentence(example::invented_data_fault()),
      "The torque of joint 1 comes 3.8 ms after the motion, a fault of the recording: torque and position channel "
      "out of step (delay, p < 0.005). Shift it (recording.delay_s = -0.0038) or fix the logger.");
}

TEST(EffectSentence, FollowsTheSignOfFriction) {
  JointDiagnosis const joint = joint_of_two_hundred_replicates();
  NamedEffect effect = effect_of(*find_effect("stribeck"), 0.2);
  EXPECT_THAT(effect_sentence(joint, effect), StartsWith("Joint 1 loses 0.20 N m extra: Stribeck friction (p"));
  effect.parameters[0].value = -0.2;
  EXPECT_THAT(effect_sentence(joint, effect), StartsWith("Joint 1 loses 0.20 N m less: Stribeck friction"));
}

TEST(EffectSentence, DoesNotSayASizeThatNoRowHasShown) {
  NamedEffect const effect = effect_of(*find_effect("stribeck"), 3.0);
  EXPECT_THAT(effect_sentence(joint_of_two_hundred_replicates(), effect), HasSubstr("loses up to 0.21 N m extra"));
}

TEST(EffectSentence, TellsFaultsOfAChannelFromPhysics) {
  JointDiagnosis const joint = joint_of_two_hundred_replicates();
  EXPECT_THAT(effect_sentence(joint, effect_of(*find_effect("sensor_drift"), 0.1)),
              StartsWith("The torque channel of joint 1 is off by up to 0.21 N m, a fault of the recording:"));
  EXPECT_THAT(
      effect_sentence(joint, effect_of(*find_effect("delay"), -0.002)),
      StartsWith("The torque of joint 1 comes 2.0 ms before the motion, because the position channel is late or "
                 "because a row holds a command that the drive follows late (actuator lag):"));
  EXPECT_THAT(effect_sentence(joint, effect_of(*find_effect("encoder_eccentricity"), 0.001)),
              AllOf(StartsWith("The position of joint 1 is misread"), HasSubstr(", a fault of the recording: ")));
}

TEST(EffectSentence, CallsATorqueAFaultOnlyWhereItComesAfterItsMotion) {
  EXPECT_TRUE(is_fault(effect_of(*find_effect("delay"), 0.002)));
  EXPECT_FALSE(is_fault(effect_of(*find_effect("delay"), -0.002)));
}

TEST(EffectSentence, CallsNothingAFaultThatPhysicsExplainsAsWell) {
  NamedEffect drift = effect_of(*find_effect("sensor_drift"), 0.1);
  EXPECT_TRUE(is_fault(drift));
  drift.equivalent = {"clipping"};
  EXPECT_EQ(is_fault(drift), find_effect("clipping")->acts_on() != ActsOn::joint);
  drift.equivalent = {"payload_change"};
  EXPECT_FALSE(is_fault(drift));
  EXPECT_THAT(effect_sentence(joint_of_two_hundred_replicates(), drift),
              AllOf(StartsWith("The torque of joint 1 is off by up to 0.21 N m"), Not(HasSubstr("fault"))));
}

TEST(EffectSentence, TellsWhatBeginsAtAnInstantByIt) {
  JointDiagnosis const joint = example::invented_diagnosis().joints[0];  // 60 s
  NamedEffect drift = effect_of(*find_effect("sensor_drift"), 0.0);
  drift.places = {{"time", 20.0, 60.0, "s"}};
  drift.parameters[1].value = 1.6;
  drift.parameters[2].value = 14.678;
  EXPECT_THAT(effect_sentence(joint, drift), HasSubstr(" from 14.7 s on, a fault"));
  // what creeps by more than it steps began at once, and a push ends
  drift.parameters[0].value = -0.03;
  EXPECT_THAT(effect_sentence(joint, drift), HasSubstr(" after 20 s, a fault"));
  NamedEffect push = effect_of(*find_effect("contact"), 2.0);
  push.places = {{"time", 20.0, 22.0, "s"}};
  EXPECT_THAT(effect_sentence(joint, push), HasSubstr(" between 20.0 and 22.0 s"));
}

TEST(EffectSentence, NamesAnEffectThatTheCatalogueDoesNotKnow) {
  NamedEffect effect;
  effect.name = "some_new_thing";
  effect.acts_on = "joint";
  effect.peak = 0.5;
  EXPECT_EQ(effect_sentence(joint_of_two_hundred_replicates(), effect),
            "Joint 1 deviates by up to 0.50 N m from the model: some new thing (p = 1.0).");
}

// every effect of the catalogue, everywhere, with every sign
TEST(EffectSentence, OfEveryEffectIsOneSentenceWithItsNameAndWithoutForbiddenWords) {
  JointDiagnosis const joint = example::invented_diagnosis().joints[0];
  std::regex const too_exact("p [<=] 0?\\.?0*[1-9][0-9]{2,}");
  for (Effect const* effect : effect_choices())
    for (double value : {-0.1, 0.1})
      for (auto const& axis : joint.map) {
        NamedEffect named = effect_of(*effect, value);
        named.places = {{axis.axis, axis.cells[20].from, axis.cells[30].to, axis.unit}};
        std::string const text = effect_sentence(joint, named);
        SCOPED_TRACE(text);
        std::string name = effect->name(), lower = text;
        std::replace(name.begin(), name.end(), '_', ' ');
        std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
        EXPECT_THAT(lower, HasSubstr(name));
        EXPECT_TRUE(text.ends_with(").")) << text;
        EXPECT_TRUE(text[0] >= 'A' && text[0] <= 'Z');
        for (char const* never : {"significant", "likely", "nan", "?", "p = 0)", "p = 0;", "  ", "inf"})
          EXPECT_THAT(lower, Not(HasSubstr(never)));
        EXPECT_FALSE(std::regex_search(text, too_exact));
      }
}

TEST(PlacePhrase, SaysTwoIntervalsInOneWhereOneMirrorsTheOther) {
  JointDiagnosis const joint = example::invented_diagnosis().joints[0];  // velocity -1.1 .. 1, time 0 .. 60
  auto const phrase = [&](char const* axis, double a, double b, double c, double d, char const* unit) {
    return place_phrase(joint, std::vector<AxisInterval>{{axis, a, b, unit}, {axis, c, d, unit}});
  };
  EXPECT_EQ(phrase("velocity", -1.1, -0.52, 0.5, 1.0, "rad/s"), "above 0.50 rad/s in both directions");
  EXPECT_EQ(phrase("velocity", -0.4, -0.2, 0.2, 0.41, "rad/s"),
            "at speeds between 0.20 and 0.41 rad/s in both directions");
  EXPECT_EQ(phrase("velocity", -1.1, -0.8, 0.2, 1.0, "rad/s"), "at velocities below -0.80 rad/s and above 0.20 rad/s");
  EXPECT_EQ(phrase("time", 0.0, 5.0, 50.0, 60.0, "s"), "before 5.0 s and after 50 s");
  // both reach the end of the axis: no "above 1.0 and above 1.38"
  EXPECT_EQ(phrase("load", 1.0, 1.35, 1.38, 1.4, "N m"), "at loads between 1.0 and 1.4 N m");
  EXPECT_EQ(phrase("time", 0.0, 1.0, 1.5, 9.0, "s"), "before 9.0 s");
  EXPECT_EQ(place_phrase(joint, std::vector<AxisInterval>{}), "");
  EXPECT_EQ(place_phrase(joint, std::vector<AxisInterval>{{"time", 12.0, 60.0, "s"}}), "after 12 s");
}

TEST(PlacePhrase, SaysWhatTheIntervalTouches) {
  JointDiagnosis const joint = example::invented_diagnosis().joints[0];  // velocity -1.1 .. 1, time 0 .. 60
  auto const phrase = [&](char const* axis, double from, double to, char const* unit) {
    return place_phrase(joint, {axis, from, to, unit});
  };
  EXPECT_EQ(phrase("velocity", -1.1, 1.0, "rad/s"), "at all speeds");
  EXPECT_EQ(phrase("velocity", 0.5, 1.0, "rad/s"), "above 0.50 rad/s in the positive direction");
  EXPECT_EQ(phrase("velocity", -1.1, -0.4, "rad/s"), "above 0.40 rad/s in the negative direction");
  EXPECT_EQ(phrase("velocity", 0.1, 0.3, "rad/s"), "at speeds between 0.10 and 0.30 rad/s");
  EXPECT_EQ(phrase("since_velocity_reversal", 0.0, 0.03, "rad"), "within 0.030 rad after a reversal");
  EXPECT_EQ(phrase("since_torque_reversal", 0.0, 0.003, "rad"), "within 3.0 mrad after the torque changes its sign");
  EXPECT_EQ(phrase("time", 12.0, 60.0, "s"), "after 12 s");
  EXPECT_EQ(phrase("time", 0.0, 60.0, "s"), "all the time");
  EXPECT_EQ(phrase("frequency", 11.6, 12.6, "Hz"), "around 12 Hz");
  EXPECT_EQ(phrase("frequency", 5.0, 12.0, "Hz"), "between 5.0 and 12 Hz");
  EXPECT_EQ(phrase("order", 11.5, 12.5, "1/rad"), "around 12 waves per turn");
  EXPECT_EQ(phrase("order", 600.0, 660.0, "1/m"), "with a wavelength around 0.010 m");
  EXPECT_EQ(phrase("load", 0.95, 1.29, "N m"), "at loads between 0.95 and 1.3 N m");
  EXPECT_EQ(phrase("load", 0.951, 0.956, "N m"), "at loads between 0.951 and 0.956 N m");
  EXPECT_EQ(phrase("time", 18.93, 19.31, "s"), "between 18.9 and 19.3 s");
  EXPECT_EQ(phrase("", unknown, unknown, ""), "");
}

TEST(PlacePhrase, OfASpectrumThatIsFullSaysSo) {
  JointDiagnosis const joint = example::invented_diagnosis().joints[0];  // frequency 0.5 .. 25, order 1 .. 28
  EXPECT_EQ(place_phrase(joint, {"frequency", 0.6, 25.0, "Hz"}), "at all frequencies");
  EXPECT_EQ(place_phrase(joint, {"order", 1.0, 28.0, "1/rad"}), "at all orders of the angle");
  EXPECT_EQ(place_phrase(joint, {"order", 1.0, 28.0, "1/m"}), "at all wavelengths");
}

}  // namespace sentences_test
}  // namespace torquescope
