// What would have been named is told as a share of the torque, with what could not have been.

#include "engine/account/power_words.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace power_words_test {

TEST(PowerSentence, TellsWhatWouldHaveBeenNamedAndWhatNot) {
  DecisionAccount decision;
  EXPECT_EQ(power_sentence(decision, "rad"), "");
  decision.smallest_named = 0.0123;
  EXPECT_EQ(power_sentence(decision, "rad"),
            "A torque of 1.2 % of the whole that the model's terms do not take up would most likely have been named.");
  decision.sticking_length = 0.005;
  EXPECT_EQ(power_sentence(decision, "rad"),
            "A torque of 1.2 % of the whole that the model's terms do not take up would most likely have been named; "
            "friction that turns round within 5.0 mrad would not, because it counts as the model's own.");
}

}  // namespace power_words_test
}  // namespace torquescope
