// When unseen recordings take names away: only where the model promised much there, moved much, and was wrong.

#include "engine/unseen/unseen_refutation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using torquescope::added_torque;
using torquescope::over_recordings;
using torquescope::speak_against;
using torquescope::speak_against_a_part;
using torquescope::UnseenEnergies;

TEST(UnseenRefutation, WantsAPromiseAChangeAndNoGain) {
  EXPECT_TRUE(speak_against({{4.0, 5.0, 3.0}, 2.0}));
  EXPECT_TRUE(speak_against({{4.0, 3.9, 3.0}, 2.0})) << "a crumb of what its twins promise";
  EXPECT_FALSE(speak_against({{4.0, 3.4, 3.0}, 2.0})) << "it keeps more than a quarter";
  EXPECT_TRUE(speak_against_a_part({{4.0, 3.4, 3.0}, 2.0})) << "less than half, where training misses more, too";
  EXPECT_FALSE(speak_against_a_part({{4.0, 2.9, 3.0}, 2.0})) << "it keeps more than half";
  EXPECT_TRUE(speak_against_a_part({{4.0, 3.4, 0.3}, 2.0})) << "however little it adds";
  EXPECT_FALSE(speak_against_a_part({{4.0, 3.9, 3.0}, 3.5})) << "twins promise little";
  EXPECT_FALSE(speak_against({{4.0, 5.0, 3.0}, 3.5})) << "twins promise little";
  EXPECT_FALSE(speak_against({{4.0, 4.1, 0.5}, 2.0})) << "the rest is another matter";
}

TEST(UnseenRefutation, WantsTheTorqueThatIsAddedToBeThere) {
  double const floor = 2.0, moved = 0.8, before = 4.0;
  auto const with_share = [&](double there) {
    return UnseenEnergies{{before, before - (2.0 * there - 1.0) * moved, moved}, floor};
  };
  EXPECT_TRUE(speak_against(with_share(0.0)));
  EXPECT_TRUE(speak_against(with_share(0.2)));
  EXPECT_FALSE(speak_against(with_share(0.3))) << "its size differs, as friction of another day does";
  EXPECT_FALSE(speak_against({{before, 4.3, 0.3}, floor})) << "too little to tell";
}

// a wave that chance found in the training recording adds little, and that little is nowhere in the unseen one
TEST(UnseenRefutation, IsSureOfLittleWhereAllStretchesAgree) {
  constexpr Eigen::Index n = 4000;
  std::mt19937 draw(3);
  std::normal_distribution<double> normal;
  Eigen::VectorXd noise(n), wave(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    noise[i] = normal(draw);
    wave[i] = 0.2 * std::sin(0.3 * static_cast<double>(i));
  }
  auto const energies = [&](double there) {
    Eigen::VectorXd const before = noise + there * wave, after = before - wave;
    double const promised = noise.squaredNorm();
    return UnseenEnergies{
        {before.squaredNorm(), after.squaredNorm(), wave.squaredNorm()}, promised, added_torque(before, after)};
  };
  ASSERT_LT(energies(0.0).found.moved, 0.03 * energies(0.0).found.before);
  EXPECT_TRUE(speak_against(energies(-0.5)));
  EXPECT_FALSE(speak_against(energies(0.5)));
  EXPECT_FALSE(speak_against(energies(1.0)));
  auto doubtful = energies(-0.5);
  doubtful.blocks.clear();
  EXPECT_FALSE(speak_against(doubtful));
}

// of a law whose knocks are turned by noise, or whose columns move other terms, its own twins have little as well
TEST(UnseenRefutation, AsksForNoMoreThanTwinsThatHaveTheNames) {
  auto const with_twins = [](double share) {
    UnseenEnergies energies{{4.0, 4.5, 0.6}, 4.2};
    for (double off : {-0.02, -0.01, 0.0, 0.01, 0.02})
      energies.twins.push_back({4.0, 4.0 - (2.0 * (share + off) - 1.0) * 0.6, 0.6});
    return energies;
  };
  EXPECT_TRUE(speak_against(with_twins(1.0)));
  // nor where more than a quarter is found, in all of them without a gain
  for (double there : {0.2, 0.4}) {
    UnseenEnergies knocking = with_twins(there + 0.01);
    knocking.found = {4.0, 4.0 - (2.0 * there - 1.0) * 3.0, 3.0};
    knocking.floor = 2.0;
    EXPECT_FALSE(speak_against(knocking)) << there;
    knocking.twins = with_twins(there + 0.2).twins;
    EXPECT_TRUE(speak_against(knocking)) << there;
  }
  EXPECT_FALSE(speak_against(with_twins(0.1)));
  auto const none = over_recordings({with_twins(0.1).twins, {}});
  EXPECT_TRUE(none.empty()) << "of one recording nothing is known";
  auto const both = over_recordings({with_twins(0.1).twins, with_twins(1.0).twins});
  EXPECT_DOUBLE_EQ(both[2].before, 8.0);
  EXPECT_DOUBLE_EQ(both[2].after, 4.0 + 0.48 + 4.0 - 0.6);
}

TEST(UnseenRefutation, WithoutAFloorOnlyAWorsePredictionSpeaksAgainstNames) {
  double const unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(speak_against({{4.0, 9.0, 9.0}, unknown}));
  EXPECT_FALSE(speak_against({{4.0, 3.9, 3.0}, unknown})) << "no promise, none broken";
  EXPECT_FALSE(speak_against({{4.0, 4.1, 0.5}, unknown})) << "hardly another one";
}
