// What is said of an arm follows from the verdicts of its joints.

#include "engine/account/arm_sentences.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace torquescope {
namespace arm_sentences_test {

JointDiagnosis joint(int number, Verdict verdict, double before, double after = unknown) {
  JointDiagnosis joint;
  joint.joint = number;
  joint.verdict = verdict;
  joint.validation_relerr = before;
  joint.augmented_validation_relerr = after;
  joint.validation_torque_energy = 100.0;
  return joint;
}

JointDiagnosis with(JointDiagnosis joint, std::vector<std::string> names) {
  NamedEffect effect;
  effect.name = names.front();
  effect.equivalent.assign(names.begin() + 1, names.end());
  joint.effects.push_back(effect);
  return joint;
}

Diagnosis arm(std::vector<JointDiagnosis> joints) {
  Diagnosis diagnosis;
  diagnosis.verdict = verdict_of_arm(joints);
  diagnosis.joints = std::move(joints);
  return diagnosis;
}

TEST(ArmSentence, NamesJointsByVerdictAndTheErrorOverAll) {
  Diagnosis const diagnosis =
      arm({joint(1, Verdict::none, 0.03), with(joint(2, Verdict::named, 0.05, 0.03), {"load_dependent_friction"}),
           with(joint(3, Verdict::one_of_class, 0.05, 0.03), {"spring", "cable"})});
  EXPECT_EQ(
      arm_reason_sentence(diagnosis),
      "Named at joint 2 (load dependent friction); named at joint 3 (spring or cable); nothing missing at joint 1. "
      "Validation error over all joints and samples 4.4 % to 3.0 %.");
}

TEST(ArmSentence, CountsJointsOfWhichNothingElseIsSaid) {
  EXPECT_EQ(
      arm_reason_sentence(arm({joint(1, Verdict::none, 0.03), joint(2, Verdict::none, 0.03),
                               joint(3, Verdict::insufficient, 0.03), joint(4, Verdict::none, 0.03)})),
      "The recordings cannot tell at joint 3; nothing missing at joints 1, 2 and 4. Validation error over all joints "
      "and samples 3.0 %.");
}

TEST(ArmSentence, PromisesNothingWhereNothingIsNamed) {
  EXPECT_EQ(arm_reason_sentence(arm({joint(1, Verdict::none, 0.03), joint(2, Verdict::unexplained, 0.03)})),
            "Unexplained at joint 2; nothing missing at joint 1. Validation error over all joints and samples 3.0 %.");
}

TEST(VerdictOfArm, IsWholeOnlyWhereNoJointIsARiddle) {
  auto const of = [](std::vector<Verdict> const& verdicts) {
    std::vector<JointDiagnosis> joints;
    for (Verdict const verdict : verdicts) joints.push_back(joint(1, verdict, 0.03));
    return verdict_of_arm(joints);
  };
  using enum Verdict;
  EXPECT_EQ(of({none, none}), none);
  EXPECT_EQ(of({none, insufficient}), none);
  EXPECT_EQ(of({insufficient, insufficient}), insufficient);
  EXPECT_EQ(of({none, named}), named);
  EXPECT_EQ(of({one_of_class, named}), one_of_class);
  EXPECT_EQ(of({unexplained, named}), partly);
  EXPECT_EQ(of({data_fault, one_of_class}), partly);
  EXPECT_EQ(of({partly, none}), partly);
  EXPECT_EQ(of({data_fault, none}), data_fault);
  EXPECT_EQ(of({data_fault, unexplained}), unexplained);
}

}  // namespace arm_sentences_test
}  // namespace torquescope
