#include "engine/simulate/turns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
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

namespace turns_test {

// as the polynomials are written, one rounding per multiply-add
double plain_sine(double turns) {
  double const within = turns - std::floor(turns + 0.5);
  double const quarters = std::nearbyint(4.0 * within);
  double const x = 2.0 * std::numbers::pi * (within - 0.25 * quarters), square = x * x;
  auto const polynomial = [&](std::vector<double> const& coefficients) {
    double value = coefficients.back();
    for (std::size_t k = coefficients.size() - 1; k-- > 0;) value = std::fma(value, square, coefficients[k]);
    return value;
  };
  double const of_sine =
      polynomial({-1.66666666666666324348e-01, 8.33333333332248946124e-03, -1.98412698298579493134e-04,
                  2.75573137070700676789e-06, -2.50507602534068634195e-08, 1.58969099521155010221e-10});
  double const of_cosine =
      polynomial({4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05,
                  -2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11});
  double const sine = std::fma(x * square, of_sine, x);
  double const half = 0.5 * square, first = 1.0 - half;
  double const cosine = first + std::fma(square * square, of_cosine, (1.0 - first) - half);
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return sine;
    case 1:
      return cosine;
    case 2:
      return -sine;
    default:
      return -cosine;
  }
}

// sin and cos of 2 pi turns, each way to the nearest double of a longer one
long double long_sine(double turns, double quarter) {
  long double const within = static_cast<long double>(turns) - std::floor(static_cast<long double>(turns) + 0.5L);
  return std::sin(2.0L * std::numbers::pi_v<long double> * (within + quarter));
}

TEST(Turns, AreWithinTheErrorTheyPromise) {
  long double largest = 0.0L;
  for (int i = 0; i < 300'000; ++i) {
    double const turns = -40.0 + 80.0 * std::fmod(0.61803398874989 * i, 1.0);
    largest = std::max(largest, std::fabs(static_cast<long double>(sine_of_turns(turns)) - long_sine(turns, 0.0)));
    largest = std::max(largest, std::fabs(static_cast<long double>(cosine_of_turns(turns)) - long_sine(turns, 0.25)));
  }
  EXPECT_LT(largest, 2.5e-16L);
}

TEST(Turns, HaveTheBitsOfThePlainPolynomialsOnEveryInstructionSet) {
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

TEST(Turns, LinesAreAddedWithTheSameBitsOnEveryInstructionSet) {
  SineLine const line{0.7, 0.3, 2.0 * std::numbers::pi * 0.7, 1.0 / (2.0 * std::numbers::pi * 0.7)};
  std::vector<double> times;
  for (int i = 0; i < 1003; ++i) times.push_back(0.0137 * i);
  for (auto const name : kernels::supported_instruction_sets()) {
    ASSERT_TRUE(kernels::force_instruction_set(name));
    for (std::size_t n : {1u, 7u, 8u, 9u, 1003u}) {
      std::vector<double> q(n, 0.1), dq(n, -0.2), ddq(n, 0.3);
      add_sine_line(line, std::span(times).first(n), q, dq, ddq);
      for (std::size_t i = 0; i < n; ++i) {
        double const turns = times[i] * line.frequency_hz + line.phase_turns;
        ASSERT_EQ(q[i], 0.1 + plain_sine(turns) * line.inverse_omega) << name << ", " << i << " of " << n;
        ASSERT_EQ(dq[i], -0.2 + cosine_of_turns(turns)) << name << ", " << i << " of " << n;
        ASSERT_EQ(ddq[i], 0.3 - plain_sine(turns) * line.omega) << name << ", " << i << " of " << n;
      }
    }
  }
  kernels::release_instruction_set();
}

}  // namespace turns_test
