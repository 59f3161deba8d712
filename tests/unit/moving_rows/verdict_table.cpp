// The verdict as a function of the facts: every row of the table, and each reason once.

#include "engine/infer/moving_rows/verdict_table.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

using namespace torquescope;

namespace verdict_table_test {

VerdictFacts nothing_missing() {
  VerdictFacts facts;
  facts.is_baseline_adequate = true;
  return facts;
}

VerdictFacts explained() {
  VerdictFacts facts;
  facts.laws = 1;
  facts.is_adequate = facts.is_held_out_lower = facts.explains_most = true;
  return facts;
}

void expect(VerdictFacts const& facts, Verdict verdict, VerdictReason reason, bool keeps_names) {
  VerdictOf const found = verdict_of(facts);
  EXPECT_EQ(found.verdict, verdict) << word(found.verdict);
  EXPECT_EQ(found.reason, reason) << word(found.reason);
  EXPECT_EQ(found.keeps_names, keeps_names);
}

TEST(VerdictTable, WithoutLaws) {
  expect(nothing_missing(), Verdict::none, VerdictReason::nothing_left, false);
  VerdictFacts poor = nothing_missing();
  poor.is_motion_poor = true;
  expect(poor, Verdict::insufficient, VerdictReason::motion_poor, false);
  VerdictFacts left;
  expect(left, Verdict::unexplained, VerdictReason::nothing_fits, false);
  left.is_motion_poor = true;
  expect(left, Verdict::unexplained, VerdictReason::nothing_fits, false);
  left.has_relation = false;
  expect(left, Verdict::data_fault, VerdictReason::no_relation, false);
}

TEST(VerdictTable, OfAnAdequateModel) {
  expect(explained(), Verdict::named, VerdictReason::explained, true);
  VerdictFacts one_of = explained();
  one_of.has_class = true;
  expect(one_of, Verdict::one_of_class, VerdictReason::explained, true);
  VerdictFacts channel = one_of;
  channel.all_on_channel = true;
  expect(channel, Verdict::data_fault, VerdictReason::explained, true);
}

TEST(VerdictTable, OfAModelThatIsNotAdequate) {
  VerdictFacts part = explained();
  part.is_adequate = false;
  expect(part, Verdict::partly, VerdictReason::partly_explained, true);
  part.explains_most = false;
  expect(part, Verdict::unexplained, VerdictReason::most_is_left, false);
}

// whatever else is true of them, names whose held-out error is not lower are not kept
TEST(VerdictTable, NeverKeepsANameWithoutALowerHeldOutError) {
  for (unsigned bits = 0; bits < 256; ++bits) {
    VerdictFacts facts;
    facts.laws = 1;
    facts.is_baseline_adequate = (bits & 1U) != 0;
    facts.is_adequate = (bits & 2U) != 0;
    facts.explains_most = (bits & 4U) != 0;
    facts.has_class = (bits & 8U) != 0;
    facts.all_on_channel = (bits & 16U) != 0;
    facts.is_motion_poor = (bits & 32U) != 0;
    facts.has_relation = (bits & 64U) != 0;
    facts.is_held_out_lower = (bits & 128U) != 0;
    VerdictOf const found = verdict_of(facts);
    EXPECT_EQ(found.keeps_names, facts.is_held_out_lower && (facts.is_adequate || facts.explains_most)) << bits;
    EXPECT_TRUE(found.keeps_names || !names_physics(found.verdict)) << bits;
  }
}

// beside an adequate baseline a law of no use for other rows is nothing missing
TEST(VerdictTable, OfALawThatChangesNoPrediction) {
  VerdictFacts facts = explained();
  facts.is_held_out_lower = false;
  expect(facts, Verdict::unexplained, VerdictReason::not_held_out, false);
  facts.is_baseline_adequate = true;
  expect(facts, Verdict::none, VerdictReason::nothing_left, false);
}

// chance excludes it, and nobody predicts better by it
TEST(VerdictTable, OfALawThatIsTooSmallToBeAFinding) {
  VerdictFacts facts = explained();
  facts.is_worth_naming = false;
  expect(facts, Verdict::none, VerdictReason::too_small, false);
  facts.all_on_channel = true;
  expect(facts, Verdict::none, VerdictReason::too_small, false);
}

// one joint of a moving arm: the load of its neighbours is no effect of the joint
TEST(VerdictTable, OfAJointThatOthersLoad) {
  for (bool const has_laws : {false, true}) {
    VerdictFacts facts = has_laws ? explained() : VerdictFacts{};
    facts.others_predict_better = true;
    expect(facts, Verdict::unexplained, VerdictReason::other_joints, false);
    facts.has_relation = false;
    expect(facts, Verdict::unexplained, VerdictReason::other_joints, false);
    facts.is_baseline_adequate = true;
    EXPECT_NE(verdict_of(facts).reason, VerdictReason::other_joints);
  }
}

TEST(VerdictTable, WordsOfReasonsDiffer) {
  std::set<std::string> words;
  for (auto const reason :
       {VerdictReason::nothing_left, VerdictReason::motion_poor, VerdictReason::nothing_fits,
        VerdictReason::no_relation, VerdictReason::not_held_out, VerdictReason::most_is_left, VerdictReason::explained,
        VerdictReason::partly_explained, VerdictReason::too_small, VerdictReason::other_joints})
    EXPECT_TRUE(words.insert(word(reason)).second) << word(reason);
}

}  // namespace verdict_table_test
