// A recording that cannot tell is refused with a finding and a way out; a good one passes.

#include "engine/infer/pipeline/recording_checks.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <ostream>
#include <string>

namespace torquescope {
namespace recording_checks_test {

Excitation good_recording() {
  Excitation facts;
  facts.duration_s = 20.0;
  facts.position_least = -1.0;
  facts.position_most = 1.2;
  facts.speed_least = -2.0;
  facts.speed_most = 2.1;
  facts.torque_least = -3.0;
  facts.torque_most = 3.1;
  facts.moving_share = 0.97;
  facts.forward_share = 0.52;
  facts.reversals = 14;
  facts.speed_spread = 6.0;
  facts.encoder_step = 2.0 * std::numbers::pi / 400000.0;
  facts.torque_limit_share = 0.001;
  return facts;
}

struct Case {
  std::string name;
  std::function<void(Excitation&)> spoil;
  Verdict verdict;
  std::string finding, way_out;  // words of
};

std::ostream& operator<<(std::ostream& out, Case const& one) { return out << one.name; }

class HopelessRecording : public testing::TestWithParam<Case> {};

TEST_P(HopelessRecording, HasItsVerdictAndAWayOut) {
  Excitation facts = good_recording();
  GetParam().spoil(facts);
  auto const found = check_recording(facts);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->verdict, GetParam().verdict);
  EXPECT_NE(found->finding.find(GetParam().finding), std::string::npos) << found->finding;
  EXPECT_NE(found->way_out.find(GetParam().way_out), std::string::npos) << found->way_out;
  // clauses: the sentence is made elsewhere
  for (auto const& clause : {found->finding, found->way_out}) EXPECT_NE(clause.back(), '.') << clause;
}

INSTANTIATE_TEST_SUITE_P(Cases, HopelessRecording,
                         testing::Values(Case{"Still", [](Excitation& e) { e.moving_share = 0.0; },
                                              Verdict::insufficient, "never moves", "record a motion"},
                                         Case{"FewSteps", [](Excitation& e) { e.encoder_step = 2.2 / 12.0; },
                                              Verdict::insufficient, "12 encoder steps", "larger motion"},
                                         Case{"HeldTorque",
                                              [](Excitation& e) {
                                                e.torque_held_rows = 20;
                                                e.torque_updates = 2.5;
                                              },
                                              Verdict::data_fault, "one row in 20", "parallel_cutoff_hz"}),
                         [](auto const& one) { return one.param.name; });

TEST(CheckSilence, SaysWhatOneSpeedCannotShow) {
  Excitation facts = good_recording();
  facts.one_speed_share = 0.3;
  EXPECT_FALSE(check_silence(facts).has_value());
  facts.one_speed_share = 0.86;
  // it is searched all the same: a ripple shows at one speed
  EXPECT_FALSE(check_recording(facts).has_value());
  auto const found = check_silence(facts);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->verdict, Verdict::insufficient);
  EXPECT_NE(found->finding.find("86 %"), std::string::npos) << found->finding;
  EXPECT_NE(found->way_out.find("four speeds"), std::string::npos) << found->way_out;
}

TEST(CheckRecording, HasNothingToSayOfAGoodOne) {
  EXPECT_FALSE(check_recording(good_recording()).has_value());
  // an encoder too fine to be seen says nothing about steps
  Excitation facts = good_recording();
  facts.encoder_step = 0.0;
  EXPECT_FALSE(check_recording(facts).has_value());
  // held, but changing fast enough
  facts.torque_held_rows = 4;
  facts.torque_updates = 12.0;
  EXPECT_FALSE(check_recording(facts).has_value());
}

// they close effects, and end no diagnosis (motion_limits.hpp)
TEST(CheckRecording, LetsOneDirectionOneSpeedAndALimitPass) {
  Excitation facts = good_recording();
  facts.forward_share = 1.0;
  facts.speed_spread = 1.05;
  facts.torque_limit_share = 0.31;
  EXPECT_FALSE(check_recording(facts).has_value());
}

TEST(CheckRecording, SeesNoMotionInNumbersThatAreNone) {
  Excitation facts = good_recording();
  facts.moving_share = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(check_recording(facts).has_value());
  EXPECT_EQ(check_recording(facts)->verdict, Verdict::insufficient);
}

}  // namespace recording_checks_test
}  // namespace torquescope
