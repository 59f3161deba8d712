// Which names hold on held-out rows, by the evidence alone: no law is exempt, and none exempts the others.

#include "engine/unseen/held_out_judgement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "engine/search/joint_refinement.hpp"
#include "unit/twin/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace held_out_judgement_test {

HeldOutGain gain_with(double t, HeldOutChange change) {
  HeldOutGain gain;
  gain.change = change;
  gain.t = t;
  gain.asked_for = 1.67;
  gain.blocks = 60;
  return gain;
}

HeldOutGain const lower = gain_with(4.0, HeldOutChange::lower), same = gain_with(0.1, HeldOutChange::not_lower),
                  higher = gain_with(-4.0, HeldOutChange::not_lower), unknown_gain{};

TEST(HeldOutEvidence, AsksEveryNameForALowerError) {
  EXPECT_EQ(refusal_of({lower, {}, false, false, false, false}), HeldOutRefusal::none);
  for (auto const& gain : {same, higher, unknown_gain})
    EXPECT_EQ(refusal_of({gain, {}, false, false, true, false}), HeldOutRefusal::not_lower);
  EXPECT_EQ(refusal_of({lower, {}, false, false, true, true}), HeldOutRefusal::spoils_unseen);
}

TEST(HeldOutEvidence, IsNotSwitchedOffByALawOfAnInstant) {
  // has_bound, all_bound, is_adequate, is_spoken_against
  EXPECT_EQ(refusal_of({same, lower, true, false, true, false}), HeldOutRefusal::not_lower) << "beside another name";
  EXPECT_EQ(refusal_of({lower, lower, true, false, true, true}), HeldOutRefusal::spoils_unseen);
  EXPECT_EQ(refusal_of({lower, lower, true, false, false, false}), HeldOutRefusal::bound_to_instant);
  EXPECT_EQ(refusal_of({lower, lower, true, false, true, false}), HeldOutRefusal::none);
}

// such a law adds nothing to another recording, which it must not spoil
TEST(HeldOutEvidence, JudgesALawOfAnInstantAloneWhereItActs) {
  EXPECT_EQ(refusal_of({same, lower, true, true, true, false}), HeldOutRefusal::none);
  EXPECT_EQ(refusal_of({same, same, true, true, true, false}), HeldOutRefusal::not_lower);
  EXPECT_EQ(refusal_of({higher, lower, true, true, true, false}), HeldOutRefusal::not_lower);
  EXPECT_EQ(refusal_of({same, lower, true, true, false, false}), HeldOutRefusal::bound_to_instant);
}

TEST(HeldOutSpoilers, AreTheWorstOneOrWhatIsBoundToAnInstant) {
  using Spoilers = std::vector<std::size_t>;
  EXPECT_EQ(spoilers_of(HeldOutRefusal::not_lower, {0.9, 0.1, 0.4}, {}), Spoilers{1});
  EXPECT_EQ(spoilers_of(HeldOutRefusal::spoils_unseen, {0.9, -0.8, -0.9}, {0}), Spoilers{2});
  EXPECT_EQ(spoilers_of(HeldOutRefusal::bound_to_instant, {0.9, 0.1, 0.0}, {2}), Spoilers{2}) << "others may be right";
  EXPECT_EQ(spoilers_of(HeldOutRefusal::bound_to_instant, {-0.9, 0.1, 0.0}, {2}), (Spoilers{2, 0}));
}

// a spring that only the training recording has, beside a push: the push must not shield it
class HeldOutJudgementOfASpring : public testing::Test {
 protected:
  static Recording with_spring(double stiffness, double push, std::uint32_t index) {
    auto joint = clean_joint();
    joint.plan.plant = plant({{"inertia", joint.truth[0]},
                              {"viscous", joint.truth[1]},
                              {"coulomb", joint.truth[2]},
                              {"offset", joint.truth[3]},
                              {"spring", stiffness},
                              {"spring_hardening", 0.0},
                              {"spring_rest", 0.0}});
    Recording recording = recorded(simulate_joint(joint.plan, index));
    for (Eigen::Index k = 0; k < recording.torque.size(); ++k)
      if (recording.time_s[k] > 3.0 && recording.time_s[k] < 4.0) recording.torque[k] += push;
    return recording;
  }

  Selection selection_of(std::vector<ShapedEffect> const& effects) const {
    auto first = make_stage(setting, clean_regressor()).value();
    Selection selection;
    selection.is_gate_open = true;
    selection.first_excess = first.energy.excess;
    for (auto const& one : effects) {
      AcceptedEffect accepted;
      accepted.effect = one.effect;
      selection.accepted.push_back(accepted);
    }
    selection.final = std::make_shared<ModelStage const>(
        make_stage(setting, JointModel(clean_regressor(), first.reference(), effects)).value());
    selection.baseline = std::make_shared<ModelStage const>(std::move(first));
    return selection;
  }

  Recording const recording = with_spring(0.3, 0.5, 1), with_it = with_spring(0.3, 0.0, 2),
                  without_it = with_spring(0.0, 0.0, 2);
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{recording, clean_regressor(), filter, section, 32, 1, 2};
  ShapedEffect const spring{find_effect("spring"), {0.0, 0.0}}, push{find_effect("contact"), {3.5, 1.0}};
};

TEST_F(HeldOutJudgementOfASpring, RefusesItBesideAPushWhereUnseenDataHaveNone) {
  Selection const both = selection_of({push, spring});
  auto const judgement = judge_held_out(setting, std::span(&without_it, 1), both, {});
  EXPECT_FALSE(judgement.holds());
  EXPECT_GT(judgement.gain.after, judgement.gain.before);
  EXPECT_THAT(judgement.spoilers, testing::Contains(1U)) << "the spring";
  EXPECT_TRUE(judge_held_out(setting, std::span(&with_it, 1), both, {}).holds());
}

// beside a prediction that is thrown off, whatever little a wave moves there may look as bad as what throws it off
TEST_F(HeldOutJudgementOfASpring, BlamesItAndNoWaveBesideIt) {
  for (double const order : {17.0, 23.0, 31.0, 41.0, 47.0}) {
    Selection const both = selection_of({{find_effect("cogging"), {order}}, spring});
    auto const judgement = judge_held_out(setting, std::span(&without_it, 1), both, {});
    EXPECT_FALSE(judgement.holds());
    EXPECT_THAT(judgement.spoilers, testing::ElementsAre(1U)) << order;
  }
}

TEST_F(HeldOutJudgementOfASpring, CrossValidatesWhereNothingUnseenWasRecorded) {
  EXPECT_TRUE(judge_held_out(setting, {}, selection_of({spring}), {}).holds());
  // a wave of the position that nothing has
  auto const judgement = judge_held_out(setting, {}, selection_of({{find_effect("cogging"), {31.0}}}), {});
  EXPECT_EQ(judgement.refusal, HeldOutRefusal::not_lower) << judgement.gain.t;
}

TEST_F(HeldOutJudgementOfASpring, ComparesTwoSelectionsOnTheRowsOfBoth) {
  auto const judged = [&](std::vector<ShapedEffect> const& effects) {
    return judge_held_out(setting, std::span(&with_it, 1), selection_of(effects), {});
  };
  auto const with_spring_named = judged({spring}), with_wave = judged({{find_effect("cogging"), {31.0}}});
  EXPECT_EQ(gain_over(with_wave, with_spring_named).change, HeldOutChange::lower);
  EXPECT_EQ(gain_over(with_spring_named, with_wave).change, HeldOutChange::not_lower);
}

}  // namespace held_out_judgement_test
