// A whole decision about a joint in closed form names what it has and nothing else, on any number of threads.

#include "engine/infer/decision/joint_decision.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "engine/infer/decision/decision_verdict.hpp"
#include "unit/decision/plants.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace joint_decision_test {

DecisionFacts decided(GivenJoint joint, int threads) {
  std::vector<Recording> const training{recording_of(joint)};
  joint.pace = 0.87;
  joint.seed += 100;
  std::vector<Recording> const validation{recording_of(joint)};
  Regressor const terms = joint_terms();
  FilterOptions const filter = ten_hertz();
  Section const section{};
  DecisionQuestion question{training, validation, terms, filter, section};
  for (auto const* name : {"asymmetric_viscous", "spring", "cogging", "speed_drag"})
    question.effects.push_back(find_effect(name));
  question.seed = 3;
  question.threads = threads;
  return decide_joint(question).facts;
}

bool is_among(Effect const* effect, EffectFacts const& accepted) {
  auto const& rivals = accepted.rivals;
  return accepted.effect == effect || std::find(rivals.begin(), rivals.end(), effect) != rivals.end();
}

std::vector<double> numbers_in(DecisionFacts const& facts) {
  std::vector<double> all{facts.torque_rms, facts.baseline.judged(), facts.final.judged(), facts.delay.late_s};
  auto const put = [&](EffectFacts const& effect) {
    all.insert(all.end(),
               {effect.gain, effect.p, effect.level, effect.size, effect.judged_before, effect.judged_after});
    all.insert(all.end(), effect.shape.begin(), effect.shape.end());
  };
  for (auto const& step : facts.steps) {
    all.insert(all.end(), {static_cast<double>(step.replicates), step.visible, step.correction.gain});
    for (auto const& effect : step.effects) put(effect);
  }
  for (auto const& effect : facts.accepted) put(effect);
  for (auto const& one : facts.parameters) all.insert(all.end(), {one.value, one.deviation});
  return all;
}

void expect_same_bits(DecisionFacts const& one, DecisionFacts const& other) {
  auto const a = numbers_in(one), b = numbers_in(other);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
}

TEST(JointDecision, NamesAFrictionThatDiffersBetweenTheDirections) {
  GivenJoint joint;
  joint.effect = [](double, double dq) { return 0.03 * std::abs(dq); };
  DecisionFacts const facts = decided(joint, 1);
  Effect const* const effect = find_effect("asymmetric_viscous");
  ASSERT_EQ(facts.accepted.size(), 1U);
  EffectFacts const& accepted = facts.accepted.front();
  EXPECT_TRUE(is_among(effect, accepted));
  EXPECT_EQ(accepted.refusal, Refusal::none);
  EXPECT_LE(accepted.p, 0.05);
  EXPECT_GT(accepted.gain, accepted.level);
  EXPECT_LT(facts.final.validation, 0.8 * facts.baseline.validation);
  if (accepted.effect == effect) {
    ASSERT_EQ(facts.parameters.size(), 5U);
    EXPECT_NEAR(facts.parameters[4].value, 0.03, 0.0006);
    EXPECT_NEAR(facts.parameters[0].value, joint.inertia, 0.01 * joint.inertia);
    EXPECT_NEAR(facts.parameters[1].value, joint.viscous, 0.01 * joint.viscous);
  }
  expect_same_bits(facts, decided(joint, 2));
}

// what a clean joint is told: so large an effect is named, and one of half the size is not
TEST(JointDecision, NamesWhatItSaysItWouldHaveNamed) {
  double const smallest = smallest_named(decided({}, 1), DecisionNumbers{});
  GivenJoint joint;
  auto const with_drag = [&](double drag) {
    joint.effect = [drag](double, double dq) { return drag * std::abs(dq); };
    return decided(joint, 1).accepted;
  };
  auto const large = with_drag(0.03);
  ASSERT_EQ(large.size(), 1U);
  double const drag = 0.03 * smallest / large.front().size;
  EXPECT_EQ(with_drag(1.5 * drag).size(), 1U);
  EXPECT_TRUE(with_drag(0.5 * drag).empty());
}

TEST(JointDecision, NamesNothingInACleanJoint) {
  DecisionFacts const facts = decided({}, 1);
  EXPECT_TRUE(facts.accepted.empty());
  ASSERT_FALSE(facts.steps.empty());
  EXPECT_EQ(facts.steps.front().effects.size(), 4U);
  for (auto const& effect : facts.steps.front().effects) EXPECT_NE(effect.refusal, Refusal::none);
  EXPECT_FALSE(facts.delay.is_named);
  EXPECT_EQ(facts.set_aside_share, 0.0);
  EXPECT_LT(facts.quiet_share, 0.02);
  ASSERT_EQ(facts.parameters.size(), 4U);
  Eigen::Vector4d const truth = truth_of({});
  for (Eigen::Index k = 0; k < 4; ++k)
    EXPECT_NEAR(facts.parameters[static_cast<std::size_t>(k)].value, truth[k], 0.01 * truth[k]);
  expect_same_bits(facts, decided({}, 2));
}

}  // namespace joint_decision_test
