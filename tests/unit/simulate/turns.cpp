#include "engine/simulate/turns.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "kernels/dispatch.hpp"

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
    std::vector<double> angles(turns.begin(), turns.begin() + count), sines(count), cosines(count), alone(count);
    sines_cosines_of_turns(angles, sines, cosines);
    sines_of_turns(angles, alone);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(sines[i], sine_of_turns(turns[i])) << i;
      EXPECT_EQ(alone[i], sines[i]) << i;
      EXPECT_EQ(cosines[i], cosine_of_turns(turns[i])) << i;
    }
  }
}

namespace {

// as the series is written, with a division per term
double plain_sine(double turns) {
  double rest = turns - std::floor(turns + 0.5);
  if (rest > 0.25) rest = 0.5 - rest;
  if (rest < -0.25) rest = -0.5 - rest;
  double const x = 2.0 * std::numbers::pi * rest, square = x * x;
  double sum = 0.0;
  for (int n = 22; n >= 2; n -= 2) sum = -(sum + 1.0) * square / static_cast<double>(n * (n + 1));
  return x + x * sum;
}

}  // namespace

TEST(Turns, HaveTheBitsOfThePlainSeriesOnEveryInstructionSet) {
  constexpr std::size_t count = 200'003;
  std::vector<double> turns;
  for (std::size_t i = 0; i < count; ++i) turns.push_back(-31.0 + 62.0 * std::fmod(0.61803398874989 * double(i), 1.0));
  for (double small : {0.0, -0.0, 1e-5, 1e-120, -1e-160, 5e-324, 0.25, -0.25, 0.5, 1e15}) turns.push_back(small);
  for (auto const name : kernels::supported_instruction_sets()) {
    ASSERT_TRUE(kernels::force_instruction_set(name));
    std::vector<double> sines(turns.size());
    sines_of_turns(turns, sines);
    std::size_t different = 0;
    for (std::size_t i = 0; i < turns.size(); ++i)
      different += std::bit_cast<std::uint64_t>(sines[i]) != std::bit_cast<std::uint64_t>(plain_sine(turns[i]));
    EXPECT_EQ(different, 0U) << name;
  }
  kernels::release_instruction_set();
}
