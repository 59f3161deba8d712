// Chance over a catalogue of two laws and three replicates, against numbers computed by hand.

#include "engine/infer/all_rows/chance.hpp"

#include <gtest/gtest.h>

using namespace torquescope;

namespace chance_test {

// T of a replicate, gain over one more than the mean of the others:
//   first law   1 / 3.5    2 / 3     3 / 2.5
//   second law  10 / 11    20 / 6    0 / 16
// the largest of each replicate: 10 / 11, 10 / 3 and 1.2. Means of all: 2 and 10
Chance by_hand() {
  Eigen::MatrixXd gains(2, 3);
  gains << 1.0, 2.0, 3.0, 10.0, 20.0, 0.0;
  return {gains};
}

double p_of(Chance const& chance, Eigen::Index law, double gain) {
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(chance.gains.rows());
  gains[law] = gain;
  return chance.p(gains)[law];
}

TEST(Chance, PCountsReplicatesWhoseLargestReachesTheGain) {
  Chance const chance = by_hand();
  Eigen::VectorXd const p = chance.p(Eigen::Vector2d(3.0, 22.0));  // T: 1 and 2
  EXPECT_DOUBLE_EQ(p[0], 3.0 / 4.0);
  EXPECT_DOUBLE_EQ(p[1], 2.0 / 4.0);
  EXPECT_DOUBLE_EQ(p_of(chance, 0, 0.0), 1.0);
  // never zero: the recording itself counts
  EXPECT_DOUBLE_EQ(p_of(chance, 0, 1e9), 1.0 / 4.0);
}

TEST(Chance, AGainCountsLessForALawThatGainsMuchByChance) {
  Chance const chance = by_hand();
  EXPECT_DOUBLE_EQ(p_of(chance, 0, 10.5), 1.0 / 4.0);  // T 3.5
  EXPECT_DOUBLE_EQ(p_of(chance, 1, 10.5), 3.0 / 4.0);  // T 0.95
}

TEST(Chance, LevelIsALawsOwnAndNeededIsTheCatalogues) {
  Chance const chance = by_hand();
  Eigen::VectorXd const level = chance.level(0.5), needed = chance.needed(0.5);
  EXPECT_DOUBLE_EQ(level[0], 2.0);
  EXPECT_DOUBLE_EQ(level[1], 10.0);
  EXPECT_DOUBLE_EQ(needed[0], 1.2 * 3.0);
  EXPECT_DOUBLE_EQ(needed[1], 1.2 * 11.0);
  for (Eigen::Index law = 0; law < 2; ++law) {
    EXPECT_DOUBLE_EQ(p_of(chance, law, needed[law] * 1.001), 0.5);
    EXPECT_GT(p_of(chance, law, needed[law] * 0.999), 0.5);
  }
  // fewer replicates than a level asks for: the largest of them
  EXPECT_DOUBLE_EQ(chance.level(0.01)[1], 20.0);
  EXPECT_DOUBLE_EQ(chance.needed(0.01)[0], 10.0);
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
