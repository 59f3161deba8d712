// When a held-out error is clearly lower: by a paired test over blocks, whatever share it falls by.

#include "engine/fit/statistics/held_out_gain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>

#include "engine/fit/statistics/student_t.hpp"

using torquescope::Blocks;
using torquescope::held_out_blocks;
using torquescope::held_out_gain;
using torquescope::HeldOutBlock;
using torquescope::HeldOutChange;
using torquescope::HeldOutGain;
using torquescope::normal_quantile_95;
using torquescope::student_t_quantile;

namespace held_out_gain_test {

constexpr Eigen::Index rows_per_block = 20, n_blocks = 60, rows = rows_per_block * n_blocks;

Eigen::VectorXd noise(Eigen::Index count, unsigned seed) {
  std::mt19937 draw(seed);
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(count, [&] { return normal(draw); });
}

// 1 in every tenth stretch of as many rows as a block, 0 elsewhere
Eigen::VectorXd rarely() {
  return Eigen::VectorXd::NullaryExpr(rows, [](Eigen::Index i) { return i / rows_per_block % 10 == 0 ? 1.0 : 0.0; });
}

HeldOutGain gain_of(Eigen::VectorXd const& before, Eigen::VectorXd const& after, Blocks which) {
  return held_out_gain(held_out_blocks(before, after, rows_per_block), which);
}

// an effect of that torque, predicted with an error of its own size times `wrong`
HeldOutGain with_effect(Eigen::VectorXd const& effect, double wrong, unsigned seed, Blocks which) {
  Eigen::VectorXd const left = noise(rows, seed);
  return gain_of(left + effect, left + wrong * effect.cwiseProduct(noise(rows, seed + 1)), which);
}

class HeldOutGainOf : public testing::TestWithParam<Blocks> {};

TEST(StudentT, HasTheTabledQuantiles) {
  EXPECT_NEAR(student_t_quantile(normal_quantile_95, 1.0), 6.3138, 1e-3);
  EXPECT_NEAR(student_t_quantile(normal_quantile_95, 2.0), 2.9200, 1e-3);
  EXPECT_NEAR(student_t_quantile(normal_quantile_95, 3.0), 2.3534, 1e-3);
  EXPECT_NEAR(student_t_quantile(normal_quantile_95, 4.0), 2.1318, 2e-3);
  EXPECT_NEAR(student_t_quantile(normal_quantile_95, 9.0), 1.8331, 1e-3);
  EXPECT_NEAR(student_t_quantile(normal_quantile_95, 59.0), 1.6711, 1e-4);
}

TEST_P(HeldOutGainOf, IsLowerWhereBlocksAgree) {
  HeldOutGain const gain = with_effect(Eigen::VectorXd::Constant(rows, 0.3), 0.1, 1, GetParam());
  EXPECT_EQ(gain.change, HeldOutChange::lower) << gain.t;
  EXPECT_LT(gain.after, gain.before);
  EXPECT_EQ(gain.blocks, 60U);
}

TEST_P(HeldOutGainOf, IsLowerWhereAnEffectActsInEveryTenthBlock) {
  EXPECT_EQ(with_effect(rarely(), 0.1, 2, GetParam()).change, HeldOutChange::lower);
}

// two of sixty, where it is three times the noise
TEST(HeldOutGain, IsLowerWhereAnEffectActsInTwoBlocksIfTheseAreAsked) {
  Eigen::VectorXd twice = Eigen::VectorXd::Zero(rows);
  twice.segment(200, 2 * rows_per_block).setConstant(3.0);
  EXPECT_EQ(with_effect(twice, 0.1, 3, Blocks::where_it_acts).change, HeldOutChange::lower);
  EXPECT_EQ(with_effect(twice, 0.1, 3, Blocks::alike).change, HeldOutChange::not_lower);
}

// it acts everywhere, and gains in one stretch alone: something else is there
TEST_P(HeldOutGainOf, IsNotLowerWhereAnEffectThatActsEverywhereGainsInOneBlock) {
  Eigen::VectorXd const left = noise(rows, 4), effect = 0.5 * noise(rows, 5);
  Eigen::VectorXd before = left, after = left + effect;
  after.segment(400, rows_per_block) = left.segment(400, rows_per_block);
  before.segment(400, rows_per_block).array() += 6.0;
  HeldOutGain const gain = gain_of(before, after, GetParam());
  EXPECT_LT(gain.after, gain.before);
  EXPECT_EQ(gain.change, HeldOutChange::not_lower) << gain.t;
}

TEST_P(HeldOutGainOf, IsNotLowerByChanceMoreOftenThanAsked) {
  int lower = 0;
  constexpr int trials = 1000;
  for (unsigned seed = 0; seed < trials; ++seed) {
    // two models of the same worth
    Eigen::VectorXd const left = noise(rows, 3 * seed);
    if (gain_of(left + 0.3 * noise(rows, 3 * seed + 1), left + 0.3 * noise(rows, 3 * seed + 2), GetParam()).change ==
        HeldOutChange::lower)
      ++lower;
  }
  // 5 % and three standard deviations of a count
  EXPECT_LT(lower, 0.05 * trials + 3.0 * std::sqrt(0.05 * 0.95 * trials));
  EXPECT_GT(lower, 0.02 * trials) << "a test that is never passed says nothing";
}

// of blocks that repeat one another there are fewer than it seems
TEST_P(HeldOutGainOf, CountsBlocksThatRepeatEachOtherForLess) {
  Eigen::Index const few_blocks = 12;
  Eigen::VectorXd const left = noise(few_blocks * rows_per_block, 6);
  auto const few = held_out_blocks(left.array() + 0.3, left, rows_per_block);
  std::vector<HeldOutBlock> repeated;
  for (auto const& block : few)
    for (int i = 0; i < 5; ++i) repeated.push_back(block);
  double const independent = held_out_gain(few, GetParam()).t;
  EXPECT_LT(held_out_gain(repeated, GetParam()).t, 1.5 * independent)
      << "without weights it would be 2.2 times as much";
}

TEST_P(HeldOutGainOf, KnowsNothingOfFewBlocksOrOfNoNumbers) {
  auto blocks = held_out_blocks(noise(rows, 7).array() + 0.5, noise(rows, 7), rows_per_block);
  EXPECT_EQ(held_out_gain(blocks, GetParam()).change, HeldOutChange::lower);
  EXPECT_EQ(held_out_gain(std::span(blocks).first(7), GetParam()).change, HeldOutChange::undecided);
  blocks[3].after = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(held_out_gain(blocks, GetParam()).change, HeldOutChange::undecided);
  EXPECT_EQ(held_out_gain({}, GetParam()).change, HeldOutChange::undecided);
}

TEST_P(HeldOutGainOf, IsNotWorseWithinChance) {
  Eigen::VectorXd const left = noise(rows, 8);
  EXPECT_TRUE(gain_of(left, left, GetParam()).is_not_worse());
  EXPECT_FALSE(gain_of(left, left.array() + 0.3, GetParam()).is_not_worse());
}

INSTANTIATE_TEST_SUITE_P(AllBlocksAlikeAndWhereTheEffectActs, HeldOutGainOf,
                         testing::Values(Blocks::alike, Blocks::where_it_acts));

}  // namespace held_out_gain_test
