#include "engine/simulate/turns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace torquescope;

TEST(Turns, AgreeWithTheMathematicsLibrary) {
  for (double turns = -2.0; turns <= 2.0; turns += 0.00137) {
    // the library's argument 2 pi turns is rounded: up to one ULP of 4 pi
    EXPECT_NEAR(sine_of_turns(turns), std::sin(2.0 * std::numbers::pi * turns), 2e-15) << turns;
    EXPECT_NEAR(cosine_of_turns(turns), std::cos(2.0 * std::numbers::pi * turns), 2e-15) << turns;
  }
}

TEST(Turns, QuartersAreExact) {
  for (double whole : {-3.0, 0.0, 1.0, 1e6}) {
    EXPECT_EQ(sine_of_turns(whole), 0.0);
    EXPECT_EQ(sine_of_turns(whole + 0.5), 0.0);
    EXPECT_DOUBLE_EQ(sine_of_turns(whole + 0.25), 1.0);
    EXPECT_DOUBLE_EQ(cosine_of_turns(whole), 1.0);
    EXPECT_DOUBLE_EQ(cosine_of_turns(whole + 0.5), -1.0);
  }
}

TEST(Turns, SquaresAddUpToOne) {
  for (double turns = -0.6; turns <= 0.6; turns += 0.00071) {
    double const s = sine_of_turns(turns), c = cosine_of_turns(turns);
    EXPECT_NEAR(s * s + c * c, 1.0, 8e-16);
  }
}

TEST(Turns, OfManyAnglesHaveTheBitsOfEach) {
  std::vector<double> turns;
  for (int i = 0; i < 75; ++i) turns.push_back(-40.0 + 1.0937 * i);
  for (std::size_t count : {1u, 15u, 16u, 17u, 75u}) {
    std::vector<double> angles(turns.begin(), turns.begin() + count), sines(count), cosines(count);
    sines_of_turns(angles, sines);
    quarter_ahead(angles);
    sines_of_turns(angles, cosines);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(sines[i], sine_of_turns(turns[i])) << i;
      EXPECT_EQ(cosines[i], cosine_of_turns(turns[i])) << i;
    }
  }
}
