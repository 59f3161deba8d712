// Names of a joint after simulations, from facts alone.

#include "engine/diagnose/loop_names.hpp"

#include <gtest/gtest.h>

using namespace torquescope;

namespace loop_names_test {

KeptMove kept(char const* name, double value, std::vector<char const*> const& rivals = {}) {
  KeptMove move{{find_effect(name)}, 50.0, 0.02, {{name, "N m", value, value - 0.1, value + 0.1}}, {}};
  for (auto const* rival : rivals) move.rivals.push_back({find_effect(rival)});
  return move;
}

LoopFacts simulated(std::vector<KeptMove> moves) {
  LoopFacts facts;
  facts.reason = LoopReason::decides;
  facts.kept = std::move(moves);
  facts.numbers = {{"inertia", "kg m2", 0.1, 0.09, 0.11}, {"loop_kp", "1", 5.0, 4.0, 6.0}};
  return facts;
}

struct Scanned {
  DecisionFacts facts{};
  JointDiagnosis joint{};
};

// each with one number of 1, and a place that the rows showed
Scanned scanned(std::vector<char const*> const& effects) {
  Scanned scan;
  for (auto const* name : effects) {
    scan.facts.accepted.push_back({find_effect(name)});
    NamedEffect named = named_after(*find_effect(name));
    named.parameters = {{name, "N m", 1.0, 0.9, 1.1}};
    named.rms = 0.5;
    scan.joint.effects.push_back(named);
  }
  scan.joint.augmented = {{"inertia", "kg m2", 0.2, 0.1, 0.3}};
  scan.joint.augmented_train_relerr = 0.05;
  return scan;
}

JointDiagnosis after(Scanned scan, LoopFacts const& loop) {
  keep_standing(scan.joint, scan.facts, loop, standing_names(scan.facts, loop));
  return scan.joint;
}

TEST(LoopNames, OfTheScansModelKeepWhatTheRowsShow) {
  JointDiagnosis const joint = after(scanned({"cable"}), simulated({kept("gravity", 0.4, {"cable"})}));
  ASSERT_EQ(joint.effects.size(), 1u);
  EXPECT_EQ(joint.effects[0].name, "cable");
  EXPECT_TRUE(joint.effects[0].equivalent.empty());
  EXPECT_EQ(joint.effects[0].parameters[0].value, 1.0);
  EXPECT_EQ(joint.augmented_train_relerr, 0.05);
}

TEST(LoopNames, OfAnotherModelHaveItsClassesAndNumbers) {
  JointDiagnosis const joint = after(scanned({"cable", "end_stop", "stribeck"}),
                                     simulated({kept("gravity", 0.4, {"cable", "spring"}), kept("stribeck", 0.35)}));
  ASSERT_EQ(joint.effects.size(), 2u);
  EXPECT_EQ(joint.effects[0].name, "stribeck");
  EXPECT_EQ(joint.effects[0].parameters[0].value, 0.35);
  EXPECT_EQ(joint.effects[0].rms, 0.5);  // as the rows show it
  EXPECT_EQ(joint.effects[1].name, "gravity");
  EXPECT_EQ(joint.effects[1].equivalent, (std::vector<std::string>{"cable", "spring"}));
  ASSERT_EQ(joint.augmented.size(), 1u);  // numbers of the controller are none of the joint's
  EXPECT_EQ(joint.augmented[0].value, 0.1);
  EXPECT_TRUE(std::isnan(joint.augmented_train_relerr));
}

TEST(LoopNames, WavesOfOneEffectAreOneNameWithNumberedParameters) {
  JointDiagnosis const joint =
      after(scanned({"cogging", "spring"}), simulated({kept("cogging", 0.1), kept("cogging", 0.2)}));
  ASSERT_EQ(joint.effects.size(), 1u);
  ASSERT_EQ(joint.effects[0].parameters.size(), 2u);
  EXPECT_EQ(joint.effects[0].parameters[1].name, "cogging_2");
  EXPECT_EQ(joint.effects[0].parameters[1].value, 0.2);
}

}  // namespace loop_names_test
