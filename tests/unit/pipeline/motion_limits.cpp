// A motion that cannot tell some effects closes these, and only when nothing is found does it take the blame.

#include "engine/infer/pipeline/motion_limits.hpp"

#include <gtest/gtest.h>

#include <string>

#include "engine/infer/pipeline/shared_constants.hpp"
#include "unit/pipeline/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace motion_limits_test {

Excitation rich_motion() {
  Excitation facts;
  facts.moving_share = 0.97;
  facts.forward_share = 0.52;
  facts.speed_spread = 6.0;
  facts.torque_limit_share = 0.001;
  return facts;
}

Excitation with(double Excitation::*fact, double value) {
  Excitation facts = rich_motion();
  facts.*fact = value;
  return facts;
}

bool closes_effect(Excitation const& facts, char const* effect, double relerr = 0.05) {
  return closes(limits_of(facts, relerr), *find_effect(effect));
}

TEST(MotionLimits, ARichMotionClosesNothing) {
  for (auto const* effect : effect_choices())
    EXPECT_FALSE(closes(limits_of(rich_motion(), 0.05), *effect)) << effect->name();
  EXPECT_FALSE(blamed_for_silence(limits_of(rich_motion(), 0.05), rich_motion(), 0.05).has_value());
  EXPECT_EQ(closed_sentences(limits_of(rich_motion(), 0.05), rich_motion()), "");
}

TEST(MotionLimits, OneDirectionClosesWhatNeedsReversals) {
  for (double const share : {1.0, 0.0}) {
    Excitation const facts = with(&Excitation::forward_share, share);
    for (auto const* effect : {"presliding", "maxwell_slip", "backlash", "breakaway_dwell"})
      EXPECT_TRUE(closes_effect(facts, effect)) << effect;
    for (auto const* effect : {"cogging", "spring", "cable", "joint_elasticity", "stribeck", "clipping"})
      EXPECT_FALSE(closes_effect(facts, effect)) << effect;
    auto const why = blamed_for_silence(limits_of(facts, 0.05), facts, 0.05);
    ASSERT_TRUE(why.has_value());
    EXPECT_EQ(why->verdict, Verdict::insufficient);
    EXPECT_NE(why->finding.find("one direction"), std::string::npos);
    EXPECT_NE(why->way_out.find("both directions"), std::string::npos);
    EXPECT_NE(closed_sentences(limits_of(facts, 0.05), facts).find("one direction"), std::string::npos);
  }
}

TEST(MotionLimits, OneWayAtOneSpeedTellsPlaceFromTimeAfterATurnAlone) {
  Excitation facts = with(&Excitation::speed_spread, 1.05);
  facts.forward_share = 1.0;
  facts.position_least = 0.5;
  facts.position_most = 4.2;
  auto const why = place_is_time(limits_of(facts, 0.05), facts, JointKind::revolute);
  ASSERT_TRUE(why.has_value());
  EXPECT_EQ(why->verdict, Verdict::insufficient);
  EXPECT_NE(why->finding.find("no place twice"), std::string::npos);
  Excitation turns = facts;
  turns.position_most = 7.0;
  EXPECT_FALSE(place_is_time(limits_of(turns, 0.05), turns, JointKind::revolute).has_value());
  EXPECT_TRUE(place_is_time(limits_of(turns, 0.05), turns, JointKind::prismatic).has_value());
  for (double Excitation::*other : {&Excitation::speed_spread, &Excitation::forward_share}) {
    Excitation tells = facts;
    tells.*other = rich_motion().*other;
    EXPECT_FALSE(place_is_time(limits_of(tells, 0.05), tells, JointKind::revolute).has_value());
  }
}

TEST(MotionLimits, OneSpeedClosesEffectsOfTheVelocity) {
  Excitation const facts = with(&Excitation::speed_spread, 1.05);
  for (auto const* effect : {"stribeck", "power_law_viscous", "speed_drag", "asymmetric_viscous"})
    EXPECT_TRUE(closes_effect(facts, effect)) << effect;
  for (auto const* effect : {"cogging", "spring", "position_dependent_friction", "delay"})
    EXPECT_FALSE(closes_effect(facts, effect)) << effect;
  auto const why = blamed_for_silence(limits_of(facts, 0.05), facts, 0.05);
  ASSERT_TRUE(why.has_value());
  EXPECT_NE(why->way_out.find("four speeds"), std::string::npos);
}

TEST(MotionLimits, ATorqueThatTheBaselineHardlyExplainsIsSearched) {
  for (auto const* effect : effect_choices()) EXPECT_FALSE(closes_effect(rich_motion(), effect->name().c_str(), 0.97));
  auto const why = blamed_for_silence(limits_of(rich_motion(), 0.97), rich_motion(), 0.97);
  ASSERT_TRUE(why.has_value());
  EXPECT_EQ(why->verdict, Verdict::data_fault);
  EXPECT_NE(why->finding.find("97 %"), std::string::npos);
}

TEST(MotionLimits, ATorqueAtItsLimitLeavesClippingOpen) {
  Excitation const facts = with(&Excitation::torque_limit_share, 0.31);
  EXPECT_FALSE(closes_effect(facts, "clipping"));
  EXPECT_NE(closed_sentences(limits_of(facts, 0.05), facts).find("31 %"), std::string::npos);
}

TEST(MotionLimits, SaturatedSamplesAreLeftOutWithWhatTheFilterMixes) {
  Recording recording;
  recording.rate_hz = 100.0;
  recording.torque.setLinSpaced(200, -1.0, 1.0);
  for (bool const left_out : saturated_samples(recording, 10.0)) EXPECT_FALSE(left_out) << "its two extremes";
  recording.torque.segment(100, 20).setConstant(2.0);
  auto const left_out = saturated_samples(recording, 10.0);
  for (std::size_t k = 10; k < left_out.size(); ++k) EXPECT_EQ(left_out[k], k >= 95 && k <= 124) << k;
  // switched on and off: two levels are no limits
  recording.torque.head(100).setConstant(0.0);
  recording.torque.tail(100).setConstant(-0.045);
  for (bool const one : saturated_samples(recording, 10.0)) EXPECT_FALSE(one);
}

TEST(SharedConstants, OfAMotionInOneDirectionOneIsKept) {
  auto joint = clean_joint();
  Recording recording = recorded(simulate_joint(joint.plan, 3));
  auto const dropped_of = [](Recording const& one) {
    return terms_to_drop(clean_regressor(), clean_pipeline(one).prepare(one));
  };
  EXPECT_TRUE(dropped_of(recording).empty());
  // forwards all the time, faster and slower
  for (Eigen::Index k = 0; k < recording.position.size(); ++k)
    recording.position[k] = 2.0 * recording.time_s[k] + 0.2 * std::sin(5.0 * recording.time_s[k]);
  recording.torque.setConstant(0.8);
  EXPECT_EQ(dropped_of(recording), std::vector<std::string>{"offset"});
  // at one speed viscous friction is Coulomb friction
  Recording both_ways = recorded(simulate_joint(joint.plan, 3));
  auto const at_one_speed = terms_to_drop(clean_regressor(), clean_pipeline(both_ways).prepare(both_ways), true);
  EXPECT_EQ(at_one_speed, std::vector<std::string>{"viscous"});
  // a drive that brakes: no friction, an offset
  recording.torque.setConstant(-0.8);
  EXPECT_EQ(dropped_of(recording), std::vector<std::string>{"coulomb"});
}

}  // namespace motion_limits_test
