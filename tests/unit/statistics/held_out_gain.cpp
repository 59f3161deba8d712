// When a held-out error is clearly lower: by a paired test over blocks, whatever share it falls by.

#include "engine/statistics/held_out_gain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "engine/statistics/student_t.hpp"

using torquescope::held_out_gain;
using torquescope::HeldOutBlock;
using torquescope::HeldOutChange;
using torquescope::normal_quantile_95;
using torquescope::student_t_quantile;

namespace {

// noise energies of blocks of 20 rows; gain: of the root mean square, everywhere or in every tenth block
std::vector<HeldOutBlock> blocks_with(std::size_t count, double gain, bool is_rare, unsigned seed) {
  constexpr double rows = 20.0, spread = 0.05;
  std::mt19937 draw(seed);
  std::normal_distribution<double> normal;
  std::vector<HeldOutBlock> blocks;
  for (std::size_t i = 0; i < count; ++i) {
    double const before = 1.0 + 0.2 * normal(draw);
    bool const acts = !is_rare || i % 10 == 0;
    double const after = before - (acts ? gain : 0.0) + spread * normal(draw);
    blocks.push_back({rows * before * before, rows * after * after, rows});
  }
  return blocks;
}

}  // namespace

TEST(StudentT, HasTheTabledQuantiles) {
  EXPECT_NEAR(student_t_quantile(normal_quantile_95, 4.0), 2.1318, 2e-3);
  EXPECT_NEAR(student_t_quantile(normal_quantile_95, 9.0), 1.8331, 1e-3);
  EXPECT_NEAR(student_t_quantile(normal_quantile_95, 59.0), 1.6711, 1e-4);
}

TEST(HeldOutGain, IsLowerWhereBlocksAgree) {
  auto const gain = held_out_gain(blocks_with(60, 0.03, false, 1));
  EXPECT_EQ(gain.change, HeldOutChange::lower) << gain.t;
  EXPECT_LT(gain.after, gain.before);
  EXPECT_EQ(gain.blocks, 60U);
}

TEST(HeldOutGain, IsLowerWhereALawActsInFewBlocks) {
  EXPECT_EQ(held_out_gain(blocks_with(60, 0.5, true, 2)).change, HeldOutChange::lower);
}

TEST(HeldOutGain, IsNotLowerByChanceMoreOftenThanAsked) {
  int lower = 0;
  constexpr int trials = 1000;
  for (unsigned seed = 0; seed < trials; ++seed)
    if (held_out_gain(blocks_with(60, 0.0, false, 100 + seed)).change == HeldOutChange::lower) ++lower;
  // 5 % and three standard deviations of a count
  EXPECT_LT(lower, 0.05 * trials + 3.0 * std::sqrt(0.05 * 0.95 * trials));
}

TEST(HeldOutGain, IsNotLowerWhereOneBlockPaysForAll) {
  auto blocks = blocks_with(60, 0.02, false, 3);
  blocks[7].after += 400.0 * blocks[7].before;
  auto const gain = held_out_gain(blocks);
  EXPECT_EQ(gain.change, HeldOutChange::not_lower);
  EXPECT_GT(gain.after, gain.before);
}

// of blocks that repeat one another there are fewer than it seems
TEST(HeldOutGain, CountsBlocksThatRepeatEachOtherForLess) {
  auto const few = blocks_with(12, 0.03, false, 4);
  std::vector<HeldOutBlock> repeated;
  for (auto const& block : few)
    for (int i = 0; i < 5; ++i) repeated.push_back(block);
  double const independent = held_out_gain(few).t;
  EXPECT_LT(held_out_gain(repeated).t, 1.5 * independent) << "without weights it would be 2.2 times as much";
}

TEST(HeldOutGain, KnowsNothingOfFewBlocksOrOfNoNumbers) {
  EXPECT_EQ(held_out_gain(blocks_with(7, 0.5, false, 5)).change, HeldOutChange::undecided);
  auto blocks = blocks_with(60, 0.5, false, 6);
  blocks[3].after = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(held_out_gain(blocks).change, HeldOutChange::undecided);
  EXPECT_EQ(held_out_gain({}).change, HeldOutChange::undecided);
}

TEST(HeldOutGain, IsNotWorseWithinChance) {
  EXPECT_TRUE(held_out_gain(blocks_with(60, 0.0, false, 7)).is_not_worse());
  EXPECT_FALSE(held_out_gain(blocks_with(60, -0.05, false, 8)).is_not_worse());
}
