// Which motion would tell names of a class apart, and silence where none does.

#include "engine/account/excitation_advice.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "engine/effects/effect.hpp"

using torquescope::advice_for;
using torquescope::find_effect;
using torquescope::NamedEffect;

namespace excitation_advice_test {

NamedEffect named(std::string name, std::vector<std::string> equivalent) {
  NamedEffect effect;
  effect.name = std::move(name);
  effect.equivalent = std::move(equivalent);
  return effect;
}

TEST(ExcitationAdvice, NamesTheMotionOfEachUpToTwo) {
  auto const advice = advice_for({named("presliding", {"friction_lag", "backlash"})});
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_EQ(advice[0].would_separate, (std::vector<std::string>{"presliding", "friction_lag", "backlash"}));
  EXPECT_EQ(advice[0].lacks,
            find_effect("presliding")->separated_by() + "; " + find_effect("friction_lag")->separated_by());
}

TEST(ExcitationAdvice, HasNoneForASingleName) { EXPECT_TRUE(advice_for({named("stribeck", {})}).empty()); }

TEST(ExcitationAdvice, OfNothingNamedIsForWhatCameClosest) {
  std::vector<torquescope::Candidate> candidates(4);
  candidates[0].name = "breakaway_dwell";
  candidates[0].cv_gain = 0.1;
  candidates[1].name = "backlash";
  candidates[1].cv_gain = 0.3;
  candidates[2].name = "cable";
  candidates[3].name = "payload_change";
  candidates[3].cv_gain = -3e6;
  EXPECT_EQ(torquescope::closest_of(candidates), std::vector<std::string>{"backlash"});
  auto const advice = torquescope::advice_to_confirm({"backlash"});
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_EQ(advice[0].lacks, find_effect("backlash")->separated_by());
  EXPECT_EQ(advice[0].would_separate, std::vector<std::string>{"backlash"});
  EXPECT_EQ(torquescope::advice_to_confirm({"backlash", "offset", "cable", "spring"}).size(), 2u);
  candidates[0].cv_gain = candidates[1].cv_gain = -0.1;
  EXPECT_TRUE(torquescope::closest_of(candidates).empty());
  EXPECT_TRUE(torquescope::closest_of({}).empty());
}

TEST(ExcitationAdvice, IsSilentOfTermsThatNoMotionTellsApart) {
  EXPECT_TRUE(advice_for({named("offset", {"coulomb_negative", "coulomb_positive"})}).empty());
}

}  // namespace excitation_advice_test
