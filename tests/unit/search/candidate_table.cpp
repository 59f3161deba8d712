// Every candidate that is not named says why, by what became of it in the search.

#include "engine/infer/search/candidate_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace torquescope {
namespace candidate_table_test {

using ::testing::HasSubstr;

EffectScan scan_of(char const* name, double gain) {
  EffectScan scan;
  scan.effect = find_effect(name);
  scan.is_testable = true;
  scan.z = 9.0;
  scan.p = 0.001;
  scan.gain = gain;
  return scan;
}

// stribeck is the best, presliding was refined as well, cogging was not, backlash is within chance, gravity untestable
Selection selection_of(bool is_gate_open) {
  Selection selection;
  selection.first_scan = {scan_of("stribeck", 9.0), scan_of("presliding", 8.0), scan_of("cogging", 1.0),
                          scan_of("backlash", 0.5), scan_of("delay", 0.4),      scan_of("gravity", 0.0)};
  selection.first_scan.back().is_testable = false;
  selection.first_q = {0.001, 0.001, 0.001, 0.4, 0.001, 1.0};
  selection.first_cv_gain = {8.0, 7.0, unknown, unknown, 0.3, unknown};
  selection.first_excess = 10.0;
  selection.is_gate_open = is_gate_open;
  return selection;
}

AcceptedEffect accepted(char const* name) {
  AcceptedEffect one;
  one.effect = find_effect(name);
  return one;
}

Candidate candidate(Selection const& selection, std::string const& name) {
  auto const table = candidate_table(selection, 0.05, 10.0);
  return *std::find_if(table.begin(), table.end(), [&](Candidate const& one) { return one.name == name; });
}

TEST(CandidateTable, EveryOneThatIsNotNamedHasItsReason) {
  for (bool is_open : {false, true}) {
    Selection selection = selection_of(is_open);
    if (is_open) selection.accepted = {accepted("stribeck")};
    for (auto const& one : candidate_table(selection, 0.05, 10.0))
      EXPECT_EQ(one.reason.empty(), one.decision == Decision::named) << one.name;
  }
}

TEST(CandidateTable, SaysWhatKeptItFromANameAtTheFirstStep) {
  Selection selection = selection_of(true);
  selection.accepted = {accepted("stribeck")};
  EXPECT_EQ(candidate(selection, "presliding").reason, "explains less than what was named");
  EXPECT_EQ(candidate(selection, "cogging").reason, "explains less than the five best");
  EXPECT_EQ(candidate(selection, "backlash").reason, "within chance (p above 0.05)");
  EXPECT_THAT(candidate(selection, "gravity").reason, HasSubstr("the model's own columns"));
  EXPECT_EQ(candidate(selection_of(false), "stribeck").reason, "too little to look for: below 0.25 % of the torque");
}

TEST(CandidateTable, WhatTheSearchSaidLastStands) {
  Selection selection = selection_of(true);
  selection.rejected = {{find_effect("presliding"), "first"}, {find_effect("presliding"), "last"}};
  selection.accepted = {accepted("stribeck")};
  EXPECT_EQ(candidate(selection, "presliding").reason, "last");
}

TEST(CandidateTable, AGainOnOtherBlocksIsAShareOfWhatIsThere) {
  Selection selection = selection_of(true);
  EXPECT_DOUBLE_EQ(candidate(selection, "stribeck").cv_gain, 0.8);
  EXPECT_DOUBLE_EQ(candidate(selection, "delay").cv_gain, 0.03);
  // what one takes there was there, whatever noise is counted off
  selection.first_cv_gain = {16.0, 4.0, unknown, unknown, -3.0, unknown};
  EXPECT_DOUBLE_EQ(candidate(selection, "stribeck").cv_gain, 1.0);
  EXPECT_DOUBLE_EQ(candidate(selection, "presliding").cv_gain, 0.25);
  EXPECT_LT(candidate(selection, "delay").cv_gain, 0.0);
  EXPECT_TRUE(std::isnan(candidate(selection, "cogging").cv_gain)) << "not tried";
}

TEST(CandidateTable, AFaultOfAChannelIsCalledOne) {
  Selection selection = selection_of(true);
  selection.accepted = {accepted("stribeck"), accepted("delay")};
  EXPECT_EQ(candidate(selection, "delay").decision, Decision::measurement);
  EXPECT_EQ(candidate(selection, "delay").reason, "a fault of the recorded torque");
}

TEST(CandidateTable, WhatFitsAsWellSaysAsWhat) {
  auto table = candidate_table(selection_of(true), 0.05, 10.0);
  NamedEffect stribeck;
  stribeck.name = "stribeck";
  stribeck.equivalent = {"presliding"};
  mark_equivalent(table, {stribeck});
  EXPECT_EQ(table[1].decision, Decision::equivalent);
  EXPECT_EQ(table[1].reason, "this motion cannot tell it from stribeck");
}

// what a verdict speaks of is not below a candidate that it does not mention
TEST(CandidateTable, WhatWasWithdrawnIsTheFirstLine) {
  Selection selection = selection_of(true);
  selection.accepted = {accepted("delay"), accepted("presliding")};
  auto table = candidate_table(selection, 0.05, 10.0);
  EXPECT_EQ(table[0].name, "stribeck");
  withdraw_names(table, "withdrawn: it explains less than half");
  EXPECT_EQ(table[0].name, "presliding");
  EXPECT_EQ(table[1].name, "delay");
  EXPECT_EQ(table[2].name, "stribeck");
  for (std::size_t i : {0, 1}) {
    EXPECT_EQ(table[i].decision, Decision::rejected);
    EXPECT_EQ(table[i].reason, "withdrawn: it explains less than half");
  }
  EXPECT_NE(table[2].reason, table[1].reason);
}

}  // namespace candidate_table_test
}  // namespace torquescope
