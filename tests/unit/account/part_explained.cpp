// What is said where effects explain a part: how much, how sure, where the rest is, and the names as of any verdict.

#include "engine/account/part_explained.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/account/sentences.hpp"
#include "support/example_diagnosis.hpp"

namespace torquescope {
namespace part_explained_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(PartExplained, SaysTheShareAndWhereTheRestIs) {
  JointDiagnosis joint = example::invented_partly().joints[0];
  EXPECT_EQ(part_explained_clause(joint),
            "stribeck and cogging explain 71 % of what is missing on held-out rows; what is left stands out between "
            "0.40 and 0.90 rad (21.0 % of the residual's energy)");
  joint.effects.resize(1);
  EXPECT_THAT(part_explained_clause(joint), StartsWith("stribeck explains 71 %"));
}

TEST(PartExplained, SaysNoNumberThatNobodyMeasured) {
  JointDiagnosis joint = example::invented_partly().joints[0];
  joint.explained_share = joint.unexplained[0].energy_share = unknown;
  EXPECT_EQ(part_explained_clause(joint),
            "stribeck and cogging explain a part of what is missing on held-out rows; what is left stands out between "
            "0.40 and 0.90 rad");
  joint.unexplained.clear();
  EXPECT_THAT(part_explained_clause(joint), EndsWith("; the map shows no place where the rest stands out"));
}

TEST(ReasonSentence, OfAPartNamesItsEffectsAndTheirGainBehindTheShare) {
  std::string const reason = reason_sentence(example::invented_partly());
  EXPECT_EQ(reason,
            "Stribeck and cogging explain 71 % of what is missing on held-out rows; what is left stands out between "
            "0.40 and 0.90 rad (21.0 % of the residual's energy). Joint 1 loses 0.35 N m extra below 0.12 "
            "rad/s in both directions: Stribeck friction (p < 0.005; presliding cannot be excluded). Joint 1 deviates "
            "by up to 0.060 N m from the model around 12 waves per turn: cogging torque of the motor (p < 0.005). "
            "Validation error 12.1 % to 7.8 %.");
  // the share of the training residual would stand beside that of held-out rows
  EXPECT_THAT(reason, Not(HasSubstr("stays unexplained")));
}

TEST(Verdict, OfAPartKeepsItsNames) {
  for (Verdict keeps : {Verdict::named, Verdict::one_of_class, Verdict::partly}) EXPECT_TRUE(names_physics(keeps));
  for (Verdict other : {Verdict::none, Verdict::unexplained, Verdict::insufficient, Verdict::data_fault})
    EXPECT_FALSE(names_physics(other)) << word(other);
  EXPECT_EQ(word(Verdict::partly), "partly");
}

}  // namespace part_explained_test
}  // namespace torquescope
