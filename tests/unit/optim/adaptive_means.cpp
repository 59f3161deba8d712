#include "engine/fit/optim/adaptive_means.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace adaptive_means_test {

constexpr double rounding = 1e-15;

// by hand, c = 0.1. F: Lehmer mean (0.04 + 0.64) / (0.2 + 0.8) = 0.68, so 0.45 + 0.068; CR: mean 0.6, so 0.45 + 0.06.
// Then F: 0.9 x 0.518 + 0.1 x 1; CR: 0.9 x 0.51
TEST(AdaptiveMeans, FollowTheLehmerMeanOfFAndTheMeanOfCR) {
  AdaptiveMeans means(0.1);
  EXPECT_EQ(means.means().F, 0.5);
  EXPECT_EQ(means.means().CR, 0.5);
  means.learn(std::vector<TrialControls>{{0.2, 0.3}, {0.8, 0.9}});
  EXPECT_NEAR(means.means().F, 0.518, rounding);
  EXPECT_NEAR(means.means().CR, 0.51, rounding);
  means.learn(std::vector<TrialControls>{{1.0, 0.0}});
  EXPECT_NEAR(means.means().F, 0.5662, rounding);
  EXPECT_NEAR(means.means().CR, 0.459, rounding);
}

TEST(AdaptiveMeans, StayWithoutSuccess) {
  AdaptiveMeans means(0.5);
  means.learn({});
  EXPECT_EQ(means.numbers(), (std::vector{0.5, 0.5}));
}

TEST(AdaptiveMeans, GoOnFromTheirNumbers) {
  AdaptiveMeans means(0.3);
  means.learn(std::vector<TrialControls>{{0.3, 0.4}});
  AdaptiveMeans copy(0.3);
  copy.restore(means.numbers());
  for (auto* one : {&means, &copy}) one->learn(std::vector<TrialControls>{{0.9, 0.1}});
  EXPECT_EQ(copy.numbers(), means.numbers());
}

}  // namespace adaptive_means_test
}  // namespace torquescope
