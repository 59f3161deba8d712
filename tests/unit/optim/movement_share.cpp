#include "engine/fit/optim/movement_share.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace movement_share_test {

// of the rules' nine corners, the larger of the two decides
TEST(MovementShare, FollowsTheLargerMovement) {
  MovementShare const share;
  double last = -1.0;
  for (double const large : {0.01, 0.1, 1.0}) {
    for (double small = 0.01; small < 1.5 * large; small *= 10.0) {
      EXPECT_EQ(share({small, large}), share({large, small}));
      EXPECT_NEAR(share({small, large}), share({large, large}), 0.02);
    }
    EXPECT_GT(share({large, large}), last + 0.3);
    last = share({large, large});
  }
}

TEST(MovementShare, LeavesSomethingToBothKinds) {
  MovementShare const share;
  EXPECT_NEAR(share({0.0, 0.0}), 0.15, 0.01);
  EXPECT_NEAR(share({0.1, 0.1}), 0.5, 1e-3);
  EXPECT_NEAR(share({2.0, 2.0}), 0.85, 0.01);
}

}  // namespace movement_share_test
}  // namespace torquescope
