// The table of verdicts, row by row, and what a step must show to be called adequate or complete.

#include "engine/infer/decision/decision_verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace torquescope;

namespace decision_verdict_test {

DecisionOutcome outcome(bool was_adequate, bool has_names, bool is_lower, bool is_complete) {
  DecisionOutcome of;
  of.was_adequate = was_adequate;
  of.has_names = has_names;
  of.is_lower = is_lower;
  of.is_complete = is_complete;
  return of;
}

EffectFacts effect(double p, Refusal refusal) {
  EffectFacts facts;
  facts.p = p;
  facts.refusal = refusal;
  return facts;
}

StepFacts step_with(std::vector<EffectFacts> effects, double visible) {
  StepFacts step;
  step.effects = std::move(effects);
  step.visible = visible;
  step.correction.p = 1.0;
  return step;
}

TEST(DecisionVerdict, NothingIsMissingOnlyWhereMuchCouldHaveShown) {
  EXPECT_EQ(verdict_from(outcome(true, false, false, true)), Verdict::none);
  DecisionOutcome poor = outcome(true, false, false, true);
  poor.can_tell_little = true;
  EXPECT_EQ(verdict_from(poor), Verdict::insufficient);
}

TEST(DecisionVerdict, WithoutNamesAnInadequateModelIsUnexplained) {
  EXPECT_EQ(verdict_from(outcome(false, false, false, false)), Verdict::unexplained);
}

TEST(DecisionVerdict, NamesThatDoNotLowerTheErrorAreNone) {
  EXPECT_EQ(verdict_from(outcome(false, true, false, true)), Verdict::unexplained);
  EXPECT_EQ(verdict_from(outcome(true, true, false, true)), Verdict::none);
}

TEST(DecisionVerdict, NamesBesideAnIncompleteModelExplainAPart) {
  EXPECT_EQ(verdict_from(outcome(false, true, true, false)), Verdict::partly);
  EXPECT_EQ(verdict_from(outcome(false, true, true, true)), Verdict::named);
}

TEST(DecisionVerdict, AClassAFaultAndNeighboursAreTold) {
  DecisionOutcome of = outcome(false, true, true, true);
  of.has_class = true;
  EXPECT_EQ(verdict_from(of), Verdict::one_of_class);
  of.all_on_channel = true;
  EXPECT_EQ(verdict_from(of), Verdict::data_fault);
  // the channel first: what else is missing shows once it is mended
  of.is_complete = false;
  EXPECT_EQ(verdict_from(of), Verdict::data_fault);
  of.neighbours_predict = true;
  EXPECT_EQ(verdict_from(of), Verdict::unexplained);
}

TEST(DecisionVerdict, AnEffectThatBoundsRefuseSpeaksAgainstTheModel) {
  DecisionNumbers const numbers;
  EXPECT_TRUE(is_adequate(step_with({effect(0.5, Refusal::chance)}, 0.01), numbers));
  EXPECT_TRUE(is_adequate(step_with({effect(0.01, Refusal::too_small)}, 0.01), numbers));
  EXPECT_TRUE(is_adequate(step_with({effect(0.01, Refusal::smaller)}, 0.01), numbers));
  EXPECT_FALSE(is_adequate(step_with({effect(0.01, Refusal::at_bound)}, 0.01), numbers));
  EXPECT_FALSE(is_adequate(step_with({effect(0.01, Refusal::not_predicted)}, 0.01), numbers));
  EXPECT_FALSE(bears_effects_of_clock(step_with({effect(0.01, Refusal::at_bound)}, 0.01)));
  // the second question about one model: at half the level
  EXPECT_TRUE(is_adequate(step_with({effect(0.04, Refusal::at_bound)}, 0.01), numbers));
  EXPECT_FALSE(is_adequate(step_with({effect(0.04, Refusal::none)}, 0.01), numbers));
  // effects of a clock are not asked beside such a doubt, either
  EXPECT_FALSE(bears_effects_of_clock(step_with({effect(0.04, Refusal::at_bound)}, 0.01)));
}

TEST(DecisionVerdict, ASmoothCorrectionCountsOnlyWithASize) {
  DecisionNumbers const numbers;
  StepFacts step = step_with({}, 0.01);
  step.correction.p = 0.02;
  step.correction.size = 0.5 * numbers.delta;
  EXPECT_TRUE(is_adequate(step, numbers));
  step.correction.size = 2.0 * numbers.delta;
  EXPECT_FALSE(is_adequate(step, numbers));
  EXPECT_TRUE(bears_effects_of_clock(step));
  // beside an error ten times as large it would not lower it by a twentieth
  step.error = 20.0 * numbers.delta;
  EXPECT_TRUE(is_adequate(step, numbers));
}

TEST(DecisionVerdict, AModelIsCompleteOnlyWhereAnEffectWouldHaveShown) {
  DecisionNumbers const numbers;
  std::vector<StepFacts> steps{step_with({}, 0.5 * numbers.tolerance)};
  EXPECT_TRUE(is_complete(steps, numbers));
  EXPECT_FALSE(is_complete({}, numbers));
  steps.front().visible = 2.0 * numbers.tolerance;
  // so large an effect is more than all that the model leaves
  steps.front().error = 0.5 * numbers.tolerance;
  EXPECT_TRUE(is_complete(steps, numbers));
  steps.front().error = 2.0 * numbers.tolerance;
  EXPECT_FALSE(is_complete(steps, numbers));
  steps.front().is_of_clock = true;  // short folds see less
  EXPECT_TRUE(is_complete(steps, numbers));
}

TEST(SmallestNamed, IsBeyondChanceLargeEnoughAndWorthAName) {
  DecisionNumbers const numbers;
  DecisionFacts facts;
  EXPECT_TRUE(std::isnan(smallest_named(facts, numbers)));
  facts.steps = {step_with({}, 0.5), step_with({}, 0.2 * numbers.delta), step_with({}, 0.9)};
  facts.steps.back().is_of_clock = true;  // short folds see less
  EXPECT_EQ(smallest_named(facts, numbers), numbers.delta);
  facts.steps[1].visible = 0.02;
  EXPECT_EQ(smallest_named(facts, numbers), 0.02);
  // of an error of 10 % it takes away a twentieth: 0.1^2 - 0.095^2 = 0.0312^2
  facts.steps[1].error = 0.1;
  EXPECT_NEAR(smallest_named(facts, numbers), 0.0312, 0.0001);
}

TEST(DecisionVerdict, StepsBesideEffectsSayNothingOfTheModelWithoutThem) {
  DecisionNumbers const numbers;
  DecisionFacts facts;
  facts.steps = {step_with({effect(0.01, Refusal::none)}, 0.01), step_with({effect(0.01, Refusal::at_bound)}, 0.01)};
  EXPECT_FALSE(was_adequate(facts, numbers));
  facts.steps.front() = step_with({effect(0.01, Refusal::too_small)}, 0.01);
  facts.steps.front().has_taken = true;
  EXPECT_TRUE(was_adequate(facts, numbers));
}

}  // namespace decision_verdict_test
