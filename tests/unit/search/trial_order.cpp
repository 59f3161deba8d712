// Which candidate is tried first for a name.

#include "engine/search/trial_order.hpp"

#include <gtest/gtest.h>

using torquescope::find_effect;
using torquescope::happens_once;
using torquescope::helps_elsewhere;
using torquescope::in_order_of_trial;
using torquescope::Trial;

namespace trial_order_test {

Trial trial(char const* effect, double gain, double cv_gain) {
  Trial one;
  one.refined.effect = find_effect(effect);
  one.refined.gain = gain;
  one.cv.gain = cv_gain;
  return one;
}

std::vector<std::string> names(std::vector<Trial> const& trials) {
  std::vector<std::string> result;
  for (auto const& one : trials) result.push_back(one.refined.effect->name());
  return result;
}

using Names = std::vector<std::string>;

TEST(TrialOrder, MostGainFirst) {
  EXPECT_EQ(names(in_order_of_trial({trial("gravity", 2.0, 2.0), trial("stribeck", 5.0, 5.0)})),
            (Names{"stribeck", "gravity"}));
  EXPECT_TRUE(in_order_of_trial({}).empty());
}

TEST(TrialOrder, WhatRepeatsComesBeforeAnEventWhenItHoldsOnOtherBlocks) {
  EXPECT_EQ(names(in_order_of_trial({trial("contact", 4.0, 0.0), trial("stribeck", 3.0, 2.1)})),
            (Names{"stribeck", "contact"}));
  EXPECT_EQ(names(in_order_of_trial({trial("contact", 4.0, 0.0), trial("stribeck", 3.0, 1.9)})),
            (Names{"contact", "stribeck"}));
}

TEST(TrialOrder, AnEventThatHoldsBetterOnOtherBlocksNeedNotGiveWay) {
  EXPECT_EQ(names(in_order_of_trial({trial("payload_change", 4.0, 3.5), trial("periodic_disturbance", 3.0, 2.9)})),
            (Names{"payload_change", "periodic_disturbance"}));
}

TEST(HappensOnce, AnInstantAndALimitThatWasReachedInOneBlock) {
  EXPECT_TRUE(happens_once(trial("contact", 4.0, 4.0)));
  // nine tenths in one block, and none of the gain on others
  Trial clipped = trial("clipping", 4.0, 0.5);
  clipped.most_in_a_block = 0.9;
  EXPECT_TRUE(happens_once(clipped));
  // what is left of it in others speaks for it
  clipped.cv.t = 2.5;
  EXPECT_FALSE(happens_once(clipped));
  // it is everywhere, and does not help there
  Trial stop = trial("end_stop", 4.0, 0.5);
  stop.most_in_a_block = 0.3;
  EXPECT_FALSE(happens_once(stop));
  // no law of a limit: other blocks are asked whatever it does in this one
  Trial law = trial("stribeck", 4.0, 0.5);
  law.most_in_a_block = 0.9;
  EXPECT_FALSE(happens_once(law));
}

TEST(TrialOrder, FewerParametersWinWhenTheyExplainNearlyAsMuch) {
  ASSERT_LT(find_effect("asymmetric_viscous")->parameters().size(), find_effect("stribeck")->parameters().size());
  EXPECT_EQ(names(in_order_of_trial({trial("stribeck", 1.0, 1.0), trial("asymmetric_viscous", 0.98, 0.98)})),
            (Names{"asymmetric_viscous", "stribeck"}));
  EXPECT_EQ(names(in_order_of_trial({trial("stribeck", 1.0, 1.0), trial("asymmetric_viscous", 0.96, 0.96)})),
            (Names{"stribeck", "asymmetric_viscous"}));
}

// a straight spring is one number, whatever one that hardens could be
TEST(TrialOrder, ALawThatIsPlainHereCountsAsItsPlainForm) {
  ASSERT_LT(find_effect("gravity")->parameters().size(), find_effect("spring")->parameters().size());
  Trial spring = trial("spring", 0.98, 0.98);
  spring.refined.plain_gain = 0.97;
  EXPECT_EQ(names(in_order_of_trial({trial("gravity", 1.0, 1.0), spring})), (Names{"spring", "gravity"}));
  spring.refined.plain_gain = 0.96;
  EXPECT_EQ(names(in_order_of_trial({trial("gravity", 1.0, 1.0), spring})), (Names{"gravity", "spring"}));
}

TEST(TrialOrder, AnotherWaveOfWhatIsNamedComesBeforeANewNameThatExplainsAsMuch) {
  ASSERT_LT(find_effect("cogging")->parameters().size(),
            find_effect("position_dependent_friction")->parameters().size());
  Trial again = trial("position_dependent_friction", 0.98, 0.98);
  again.is_named = true;
  EXPECT_EQ(names(in_order_of_trial({trial("cogging", 1.0, 1.0), again})),
            (Names{"position_dependent_friction", "cogging"}));
  again.refined.gain = 0.96;
  EXPECT_EQ(names(in_order_of_trial({trial("cogging", 1.0, 1.0), again})),
            (Names{"cogging", "position_dependent_friction"}));
}

TEST(TrialOrder, HelpsElsewhereByItsSpreadOrByHalfOfItsGain) {
  EXPECT_TRUE(helps_elsewhere({.gain = 0.1, .t = 2.1}, 1.0));
  EXPECT_TRUE(helps_elsewhere({.gain = 0.6, .t = 0.5}, 1.0));
  EXPECT_FALSE(helps_elsewhere({.gain = 0.4, .t = 1.9}, 1.0));
}

}  // namespace trial_order_test
