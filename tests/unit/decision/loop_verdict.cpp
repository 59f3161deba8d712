// Names that stand after simulations, from facts alone.

#include "engine/infer/decision/loop_verdict.hpp"

#include <gtest/gtest.h>

#include "engine/infer/decision/decision_verdict.hpp"
#include "engine/infer/decision/names_on_rows.hpp"

using namespace torquescope;

namespace loop_verdict_test {

LoopSubject key(LoopKey of) { return {nullptr, of}; }
LoopSubject effect(char const* name) { return {find_effect(name)}; }

DecisionFacts scanned(std::vector<char const*> const& effects, bool has_delay) {
  DecisionFacts facts;
  for (auto const* name : effects) facts.accepted.push_back({find_effect(name)});
  facts.delay.is_named = has_delay;
  return facts;
}

KeptMove kept(LoopSubject const& subject, std::vector<LoopSubject> rivals = {}) {
  return {subject, 50.0, 0.02, {{"number", "s", 0.02, 0.01, 0.03}}, std::move(rivals)};
}

LoopFacts simulated(std::vector<KeptMove> moves, LoopReason reason = LoopReason::decides, LoopForm form = LoopForm::p) {
  LoopFacts facts;
  facts.reason = reason;
  facts.form = form;
  facts.kept = std::move(moves);
  return facts;
}

TEST(LoopVerdict, LeavesTheScanAloneWhereSimulationsDoNotDecide) {
  auto const names = standing_names(scanned({"cogging"}, true),
                                    simulated({kept(key(LoopKey::goal_speed_limit))}, LoopReason::predicts_nothing));
  EXPECT_FALSE(names.by_loop);
  EXPECT_EQ(names.effects, std::vector<bool>{true});
  EXPECT_TRUE(names.has_delay);
  EXPECT_TRUE(names.added.empty());
}

TEST(LoopVerdict, AnEffectThatTheSimulationDoesNotBearOutIsNoName) {
  auto const names = standing_names(scanned({"cogging", "spring"}, false),
                                    simulated({kept(key(LoopKey::goal_speed_limit)), kept(effect("spring"))}));
  EXPECT_EQ(names.effects, (std::vector<bool>{false, true}));
  ASSERT_EQ(names.added.size(), 1u);
  EXPECT_EQ(name_of(names.added[0].subject), "goal_speed_limit");
}

TEST(LoopVerdict, AnEffectThatCannotBeToldFromAKeptOneStands) {
  auto const names =
      standing_names(scanned({"cogging"}, false), simulated({kept(effect("spring"), {effect("cogging")})}));
  EXPECT_EQ(names.effects, std::vector<bool>{true});
  EXPECT_TRUE(names.added.empty());
  EXPECT_FALSE(names.of_other_model);
  EXPECT_FALSE(names.drops_effects);
}

// cable was told from gravity beside an end stop that is not there
TEST(LoopVerdict, WhereTheScansModelFallsAClassIsThatOfSimulations) {
  auto const names = standing_names(scanned({"cable", "end_stop"}, false),
                                    simulated({kept(effect("gravity"), {effect("cable"), effect("spring")})}));
  EXPECT_TRUE(names.of_other_model);
  EXPECT_TRUE(names.drops_effects);
  EXPECT_EQ(names.effects, (std::vector<bool>{false, false}));
  ASSERT_EQ(names.added.size(), 1u);
  EXPECT_EQ(name_of(names.added[0].subject), "gravity");
  EXPECT_EQ(names.added[0].rivals.size(), 2u);
}

TEST(LoopVerdict, WhatOnlySimulationsFoundDropsNothing) {
  auto const names =
      standing_names(scanned({"cogging"}, false), simulated({kept(effect("cogging")), kept(effect("stribeck"))}));
  EXPECT_TRUE(names.of_other_model);
  EXPECT_FALSE(names.drops_effects);
}

TEST(LoopVerdict, NamesLeaveMoreWhereTheScanPredictsBetterByWhatIsWorthAName) {
  double const least_fall = 0.05;
  ModelErrors names{0.06, 0.05, 0.10}, scan{0.01, 0.01, 0.096};
  EXPECT_FALSE(leave_more(names, scan, least_fall));  // of validation: 4 %
  scan.validation = 0.094;
  EXPECT_TRUE(leave_more(names, scan, least_fall));
  names.validation = scan.validation = LoopErrors::none;  // of held-out folds
  EXPECT_TRUE(leave_more(names, scan, least_fall));
}

TEST(LoopVerdict, ADelayOfTheCommandIsTheScansDelay) {
  for (bool const named : {false, true}) {
    auto const names = standing_names(scanned({}, named), simulated({kept(key(LoopKey::command_delay_s))}));
    EXPECT_TRUE(names.has_delay);
    EXPECT_TRUE(names.added.empty());
    ASSERT_TRUE(names.command_delay);
    EXPECT_EQ(names.command_delay->value, 0.02);
  }
}

TEST(LoopVerdict, ADelayInTheClassOfALimitIsNoNameOfItsOwn) {
  auto const names = standing_names(scanned({}, true),
                                    simulated({kept(key(LoopKey::goal_speed_limit), {key(LoopKey::command_delay_s)})}));
  EXPECT_FALSE(names.has_delay);
  ASSERT_EQ(names.added.size(), 1u);
}

TEST(LoopVerdict, AnEffectOfAClockFallsOnlyToTheCommandSide) {
  auto const scan = scanned({"friction_drift"}, false);
  EXPECT_TRUE(standing_names(scan, simulated({})).effects[0]);
  EXPECT_FALSE(standing_names(scan, simulated({kept(key(LoopKey::goal_speed_limit))})).effects[0]);
}

LoopFacts asked(LoopFacts facts, std::vector<MoveFacts> const& moves) {
  facts.steps.push_back({{}, 48, moves});
  return facts;
}

TEST(LoopVerdict, WhatSimulationsCallChanceIsNoName) {
  auto const scan = scanned({"friction_drift"}, false);
  MoveFacts drift{effect("friction_drift")};
  drift.refusal = MoveRefusal::chance;
  LoopFacts const once = asked(simulated({}), {drift});
  EXPECT_FALSE(standing_names(scan, once).effects[0]);
  // beside another model it was not
  drift.refusal = MoveRefusal::not_predicted;
  EXPECT_TRUE(standing_names(scan, asked(once, {drift})).effects[0]);
}

TEST(LoopVerdict, WhatSimulationsCallChanceDoesNotSpeakAgainstTheModel) {
  DecisionNumbers const numbers;
  DecisionFacts scan = scanned({}, false);
  EffectFacts refused{find_effect("spring")};
  refused.refusal = Refusal::not_predicted;
  refused.p = 0.01;
  scan.steps.push_back({{refused}});
  MoveFacts spring{effect("spring")};
  spring.refusal = MoveRefusal::chance;
  LoopFacts const loop = asked(simulated({}), {spring});
  EXPECT_FALSE(was_adequate(scan, numbers));
  EXPECT_TRUE(was_adequate(judged_in_loop(scan, loop), numbers));
  EXPECT_FALSE(was_adequate(judged_in_loop(scan, simulated({})), numbers));
  LoopFacts of_position = loop;
  of_position.counts = {true, false};
  EXPECT_FALSE(was_adequate(judged_in_loop(scan, of_position), numbers));
  LoopFacts undecided = loop;
  undecided.reason = LoopReason::diverges;
  EXPECT_FALSE(was_adequate(judged_in_loop(scan, undecided), numbers));
}

TEST(LoopVerdict, ADelayThatNoSimulationBearsOutIsNone) {
  EXPECT_FALSE(standing_names(scanned({}, true), simulated({})).has_delay);
  // an identified controller was never asked
  EXPECT_TRUE(standing_names(scanned({}, true), simulated({}, LoopReason::decides, LoopForm::identified)).has_delay);
}

TEST(LoopVerdict, NothingIsLeftOfNothing) {
  EXPECT_FALSE(standing_names(scanned({"cogging"}, true), simulated({})).any());
  EXPECT_TRUE(standing_names(scanned({"cogging"}, false), simulated({}, LoopReason::no_reference)).any());
}

}  // namespace loop_verdict_test
