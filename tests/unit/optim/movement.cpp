#include "engine/fit/optim/movement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "engine/base/random_stream.hpp"
#include "support/optimise.hpp"

namespace torquescope {
namespace movement_test {

Population random_population(std::uint32_t generation) {
  Population population(20, 3);
  RandomStream random({6, 0, RandomDomain::test}, generation, 0);
  for (double& x : population.numbers) x = random.uniform(-1.0, 1.0);
  for (double& f : population.fitness) f = random.normal();
  return population;
}

Population scaled(Population population, double x_scale, double f_scale, double f_shift = 0.0) {
  for (double& x : population.numbers) x *= x_scale;
  for (double& f : population.fitness) f = f * f_scale + f_shift;
  return population;
}

Bounds const box = testing::cube(3, -1.0, 1.0);

// as if every member's trial had won
Movement moved(Population const& before, Population const& after, Bounds const& bounds, MovementNorm norm) {
  std::vector<std::size_t> all(before.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return movement_between(before, after, all, bounds, norm);
}

TEST(Movement, MembersThatStayedAddNothingToAnyBit) {
  auto const before = random_population(1);
  auto const other = random_population(2);
  std::vector<std::size_t> const winners{2, 3, 11, 19};
  auto after = before;
  for (std::size_t const i : winners) after.set_member(i, other.members().row(i), other.fitness[i]);
  for (auto const norm : {MovementNorm::raw, MovementNorm::relative, MovementNorm::spread}) {
    auto const of_winners = movement_between(before, after, winners, box, norm);
    auto const of_all = moved(before, after, box, norm);
    EXPECT_EQ(of_winners.PC, of_all.PC);
    EXPECT_EQ(of_winners.FC, of_all.FC);
    EXPECT_GT(of_all.PC, 0.0);
  }
}

TEST(Movement, RawIsTheRootMeanSquareOfTheSeedsEquation) {
  Population before(2, 2);
  before.numbers = {0.0, 0.0, 0.5, 0.5};
  before.fitness = {3.0, 5.0};
  Population after = before;
  after.numbers = {0.3, 0.4, 0.5, 0.5};
  after.fitness = {1.0, 5.0};
  auto const movement = moved(before, after, testing::cube(2, -1.0, 1.0), MovementNorm::raw);
  EXPECT_DOUBLE_EQ(movement.PC, std::sqrt(0.25 / 2.0));
  EXPECT_DOUBLE_EQ(movement.FC, std::sqrt(4.0 / 2.0));
}

TEST(Movement, AtRestIsZero) {
  auto const population = random_population(1);
  for (auto const norm : {MovementNorm::raw, MovementNorm::relative, MovementNorm::spread}) {
    auto const movement = moved(population, population, box, norm);
    EXPECT_EQ(movement.PC, 0.0);
    EXPECT_EQ(movement.FC, 0.0);
  }
}

TEST(Movement, RelativeKeepsItsBitsUnderPowersOfTwo) {
  auto const before = random_population(1);
  auto const after = random_population(2);
  auto const reference = moved(before, after, box, MovementNorm::relative);
  for (double const x_scale : {0x1p-30, 1.0, 0x1p10}) {
    for (double const f_scale : {0x1p-200, 1.0, 0x1p60}) {
      auto const movement = moved(scaled(before, x_scale, f_scale), scaled(after, x_scale, f_scale),
                                  testing::cube(3, -x_scale, x_scale), MovementNorm::relative);
      EXPECT_EQ(movement.PC, reference.PC);
      EXPECT_EQ(movement.FC, reference.FC);
    }
  }
}

TEST(Movement, RelativeIgnoresAnOffsetOfFitness) {
  auto const before = random_population(1);
  auto const after = random_population(2);
  auto const reference = moved(before, after, box, MovementNorm::relative);
  auto const shifted =
      moved(scaled(before, 1.0, 1.0, -1e3), scaled(after, 1.0, 1.0, -1e3), box, MovementNorm::relative);
  EXPECT_NEAR(shifted.FC, reference.FC, 1e-12);
}

TEST(Movement, SpreadKeepsItsBitsInWhateverUnitAndBox) {
  auto const before = random_population(1);
  auto const after = random_population(2);
  auto const reference = moved(before, after, box, MovementNorm::spread);
  auto const in_units = [](Population population) {
    for (std::size_t i = 0; i < population.numbers.size(); ++i) population.numbers[i] *= i % 3 == 0 ? 0x1p30 : 0x1p-9;
    return population;
  };
  auto const movement =
      moved(in_units(before), in_units(after), testing::cube(3, -0x1p30, 0x1p31), MovementNorm::spread);
  EXPECT_EQ(movement.PC, reference.PC);
  EXPECT_EQ(movement.FC, reference.FC);
  EXPECT_EQ(moved(scaled(before, 0x1p-40, 1.0), scaled(after, 0x1p-40, 1.0), box, MovementNorm::spread).PC,
            reference.PC);
}

// independent populations: a step is the difference of two numbers of the same spread
TEST(Movement, SpreadOfIndependentPopulationsIsNearRootTwo) {
  EXPECT_NEAR(moved(random_population(1), random_population(2), box, MovementNorm::spread).PC, std::sqrt(2.0), 0.3);
}

TEST(Movement, RelativeFunctionChangeIsAtMostTwo) {
  Population before(4, 1);
  Population after(4, 1);
  before.numbers = after.numbers = {0.0, 0.0, 0.0, 0.0};
  before.fitness = {1.0, 1.0, 1.0, 1.0};
  after.fitness = {0.0, 0.0, 0.0, 0.0};
  // everything moved by one, and one half is the standard deviation
  EXPECT_DOUBLE_EQ(moved(before, after, testing::cube(1, -1.0, 1.0), MovementNorm::relative).FC, 2.0);
}

TEST(Movement, MembersWithoutFiniteFitnessHaveNoFunctionChange) {
  auto before = random_population(1);
  auto after = before;
  before.fitness[3] = std::numeric_limits<double>::infinity();
  after.fitness[4] = before.fitness[4] - 2.0;
  for (auto const norm : {MovementNorm::raw, MovementNorm::relative, MovementNorm::spread}) {
    double const FC = moved(before, after, box, norm).FC;
    EXPECT_TRUE(std::isfinite(FC));
    EXPECT_GT(FC, 0.0);
  }
  EXPECT_DOUBLE_EQ(moved(before, after, box, MovementNorm::raw).FC, std::sqrt(4.0 / 20.0));
}

TEST(Movement, HugeFitnessDoesNotBecomeNan) {
  auto before = random_population(1);
  auto after = before;
  before.fitness[0] = 1.7e308;
  after.fitness[0] = -1.7e308;
  EXPECT_TRUE(std::isfinite(moved(before, after, box, MovementNorm::relative).FC));
  EXPECT_FALSE(std::isnan(moved(before, after, box, MovementNorm::raw).FC));
}

}  // namespace movement_test
}  // namespace torquescope
