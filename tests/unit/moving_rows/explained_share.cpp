// The share of the mismatch that laws explain on held-out rows, with its interval.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/infer/moving_rows/held_out.hpp"

using namespace torquescope;

namespace explained_share_test {

TEST(ExplainedShare, IsBeyondTheNoise) {
  // 2 of 10 a block is noise: 6 of the other 8 are explained
  std::vector<HeldOutBlock> const blocks(20, HeldOutBlock{10.0, 4.0, 1.0, 4.0});
  ExplainedShare const found = explained_share(blocks, 0.5);
  EXPECT_NEAR(found.share, 0.75, 1e-12);
  EXPECT_NEAR(found.low, 0.75, 1e-9) << "blocks agree";
  EXPECT_NEAR(found.high, 0.75, 1e-9);
}

// the jackknife of a ratio: against its closed form for two kinds of block
TEST(ExplainedShare, HasAnIntervalFromTheSpreadOfBlocks) {
  std::vector<HeldOutBlock> blocks;
  for (int k = 0; k < 20; ++k) blocks.push_back({10.0, k % 2 == 0 ? 2.0 : 6.0, 1.0, 1.0});
  ExplainedShare const found = explained_share(blocks, 0.0);
  EXPECT_NEAR(found.share, 0.6, 1e-12);
  // leaving one out moves the share by 2 / 190 either way
  double const error = std::sqrt(19.0 / 20.0 * 20.0) * 2.0 / 190.0;
  EXPECT_NEAR(found.high - found.share, 2.093 * error, 0.01 * error) << "Student's t, 19 degrees of freedom";
  EXPECT_NEAR(found.share - found.low, 2.093 * error, 0.01 * error);
}

TEST(ExplainedShare, IsUnknownWithoutAMismatchOrBlocks) {
  EXPECT_TRUE(std::isnan(explained_share(std::vector<HeldOutBlock>(20, HeldOutBlock{1.0, 1.0, 0.0, 1.0}), 2.0).share));
  EXPECT_TRUE(std::isnan(explained_share(std::vector<HeldOutBlock>(3, HeldOutBlock{1.0, 0.5, 0.1, 1.0}), 0.0).share));
}

}  // namespace explained_share_test
