// Chance over a catalogue of two effects and three replicates, against numbers computed by hand.

#include "engine/infer/decision/chance.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace torquescope;

namespace chance_test {

// T of a replicate: gain over 3.84 and the rms of the others' gains
//   first effect   1 / (3.84 + sqrt(6.5))    2 / (3.84 + sqrt(5))     3 / (3.84 + sqrt(2.5))
//   second effect  10 / (3.84 + sqrt(200))   20 / (3.84 + sqrt(50))   0
// the largest of each replicate: 0.556, 1.833 and 0.553
double const first_unit = 3.84 + std::sqrt(14.0 / 3.0), second_unit = 3.84 + std::sqrt(500.0 / 3.0);

Chance by_hand() {
  Eigen::MatrixXd gains(2, 3);
  gains << 1.0, 2.0, 3.0, 10.0, 20.0, 0.0;
  return {gains};
}

double p_of(Chance const& chance, Eigen::Index effect, double gain) {
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(chance.gains.rows());
  gains[effect] = gain;
  return chance.p(gains)[effect];
}

TEST(Chance, PCountsReplicatesWhoseLargestReachesTheGain) {
  Chance const chance = by_hand();
  Eigen::VectorXd const p = chance.p(Eigen::Vector2d(3.0, 22.0));  // T: 0.50 and 1.31
  EXPECT_DOUBLE_EQ(p[0], 1.0);
  EXPECT_DOUBLE_EQ(p[1], 2.0 / 4.0);
  EXPECT_DOUBLE_EQ(p_of(chance, 0, 0.0), 1.0);
  // never zero: the recording itself counts
  EXPECT_DOUBLE_EQ(p_of(chance, 0, 1e9), 1.0 / 4.0);
}

TEST(Chance, AGainCountsLessForAnEffectThatGainsMuchByChance) {
  Chance const chance = by_hand();
  EXPECT_DOUBLE_EQ(p_of(chance, 0, 6.0), 2.0 / 4.0);  // T 1.00
  EXPECT_DOUBLE_EQ(p_of(chance, 1, 6.0), 1.0);        // T 0.36
}

TEST(Chance, LevelIsAnEffectsOwnAndNeededIsTheCatalogues) {
  Chance const chance = by_hand();
  Eigen::VectorXd const level = chance.level(0.5), needed = chance.needed(0.5);
  EXPECT_DOUBLE_EQ(level[0], 2.0);
  EXPECT_DOUBLE_EQ(level[1], 10.0);
  EXPECT_DOUBLE_EQ(needed[0], 10.0 / (3.84 + std::sqrt(200.0)) * first_unit);
  EXPECT_DOUBLE_EQ(needed[1], 10.0 / (3.84 + std::sqrt(200.0)) * second_unit);
  for (Eigen::Index effect = 0; effect < 2; ++effect) {
    EXPECT_DOUBLE_EQ(p_of(chance, effect, needed[effect] * 1.001), 0.5);
    EXPECT_GT(p_of(chance, effect, needed[effect] * 0.999), 0.5);
  }
  // fewer replicates than a level asks for: the largest of them
  EXPECT_DOUBLE_EQ(chance.level(0.01)[1], 20.0);
  EXPECT_DOUBLE_EQ(chance.needed(0.01)[0], 20.0 / (3.84 + std::sqrt(50.0)) * first_unit);
}

TEST(Chance, AnEffectThatNeverGainsByChanceIsCountedInWhatOneParameterDoes) {
  EXPECT_DOUBLE_EQ(Chance{Eigen::MatrixXd::Zero(2, 3)}.relative(Eigen::Vector2d(7.68, 0.0))[0], 2.0);
}

TEST(Chance, FurtherReplicatesStandBesideTheFirst) {
  Chance chance;
  EXPECT_EQ(chance.replicates(), 0U);
  Eigen::MatrixXd const all = by_hand().gains;
  chance.add(all.leftCols(2));
  chance.add(all.rightCols(1));
  ASSERT_EQ(chance.replicates(), 3U);
  EXPECT_EQ(chance.gains, all);
}

}  // namespace chance_test
