// the promise about bits: one documented order of operations, on every instruction set and for every grouping
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "unit/kernels/documented_sum.hpp"
#include "unit/kernels/every_instruction_set.hpp"
#include "unit/kernels/random_problem.hpp"

namespace torquescope::kernels {
namespace residual_energy_bits_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

class ResidualEnergyBits : public EveryInstructionSet {};

INSTANTIATE_TEST_SUITE_P(Target, ResidualEnergyBits, testing::ValuesIn(supported_instruction_sets()),
                         instruction_set_of);

// the order written in residual_energy.hpp, one operation after the other
double energy_in_documented_order(RandomProblem const& problem, std::size_t m, double delta) {
  std::vector<double> blocks;
  for (std::size_t first = 0; first < problem.n_samples; first += 2048) {
    std::array<double, 8> lane{};
    for (std::size_t i = first; i < std::min(first + 2048, problem.n_samples); ++i) {
      double e = problem.tau[i];
      for (std::size_t r = 0; r < problem.n_regressors; ++r)
        e = std::fma(-problem.phi_at(i, r), problem.member_at(m, r), e);
      double const size = std::abs(e);
      double const capped = std::min(size, delta);
      lane[i % 8] = std::fma(capped, size + (size - capped), lane[i % 8]);
    }
    blocks.push_back(sum_of_lanes(lane));
  }
  return sum_of_blocks(std::move(blocks));
}

struct Size {
  std::size_t n_samples, n_regressors, n_members;
};
// one sample, tails of vectors, tiles and blocks, tails of groups, seven blocks (a tree with odd ones)
constexpr Size sizes[] = {{1, 1, 1},    {7, 4, 2},     {31, 3, 5},     {32, 4, 6},    {33, 4, 7},    {257, 24, 13},
                          {2047, 5, 3}, {2048, 11, 6}, {2049, 11, 11}, {5000, 4, 40}, {14000, 2, 2}, {700, 60, 9}};

TEST_P(ResidualEnergyBits, SumsSquaresInTheDocumentedOrder) {
  std::uint32_t seed = 100;
  for (auto const& size : sizes) {
    RandomProblem const problem(size.n_samples, size.n_regressors, size.n_members, ++seed);
    auto const energy = residual_energies(problem.tiles(), problem.candidates());
    for (std::size_t m = 0; m < size.n_members; ++m)
      ASSERT_EQ(energy[m], energy_in_documented_order(problem, m, infinity)) << problem.name() << ", member " << m;
  }
}

TEST_P(ResidualEnergyBits, SumsHuberLossesInTheDocumentedOrder) {
  std::uint32_t seed = 200;
  for (auto const& size : sizes) {
    RandomProblem const problem(size.n_samples, size.n_regressors, size.n_members, ++seed);
    double const delta = 1.5;
    auto const energy = huber_energies(problem.tiles(), problem.candidates(), delta);
    for (std::size_t m = 0; m < size.n_members; ++m)
      ASSERT_EQ(energy[m], energy_in_documented_order(problem, m, delta)) << problem.name() << ", member " << m;
  }
}

TEST_P(ResidualEnergyBits, GivesTheSameBitsForEveryGroupingOfMembers) {
  RandomProblem const problem(2500, 9, 23, 5);
  auto const together = residual_energies(problem.tiles(), problem.candidates());
  for (std::size_t chunk : {1, 2, 5, 6, 7, 12, 22}) {
    for (std::size_t first = 0; first < problem.n_members; first += chunk) {
      std::size_t const count = std::min(chunk, problem.n_members - first);
      auto const apart = residual_energies(problem.tiles(), problem.candidates(first, count));
      for (std::size_t m = 0; m < count; ++m) ASSERT_EQ(apart[m], together[first + m]) << "chunks of " << chunk;
    }
  }
}

TEST_P(ResidualEnergyBits, PaddingAddsExactlyZero) {
  for (std::size_t n : {1, 5, 8, 31, 40, 2047}) {
    RandomProblem const problem(n, 6, 7, static_cast<std::uint32_t>(n));
    // the same recording with zeros up to the end of the block written out as samples
    std::vector<double> phi(2048 * 6), tau(2048);
    for (std::size_t i = 0; i < n; ++i) {
      tau[i] = problem.tau[i];
      for (std::size_t r = 0; r < 6; ++r) phi[r * 2048 + i] = problem.phi_at(i, r);
    }
    AlignedDoubles packed(packed_size(2048, 6));
    auto const longer = pack_tiles(phi.data(), 2048, tau.data(), 2048, 6, packed.data());
    EXPECT_EQ(residual_energies(problem.tiles(), problem.candidates()),
              residual_energies(longer, problem.candidates()));
    EXPECT_EQ(huber_energies(problem.tiles(), problem.candidates(), 0.5),
              huber_energies(longer, problem.candidates(), 0.5));
  }
}

TEST_P(ResidualEnergyBits, HuberWithInfiniteDeltaIsResidualEnergy) {
  RandomProblem const problem(3000, 12, 8, 9);
  EXPECT_EQ(huber_energies(problem.tiles(), problem.candidates(), infinity),
            residual_energies(problem.tiles(), problem.candidates()));
}

// what lets several threads share one long recording: a run of 2^k blocks is one node of the tree
TEST_P(ResidualEnergyBits, PartsOfAPowerOfTwoOfBlocksAddUpToTheSameBits) {
  RandomProblem const problem(7 * block_samples - 100, 3, 4, 11);
  auto const whole = residual_energies(problem.tiles(), problem.candidates());
  std::size_t const left_samples = 4 * block_samples;
  SampleTiles const left{problem.packed.data(), left_samples, 3};
  SampleTiles const right{problem.packed.data() + packed_size(left_samples, 3), problem.n_samples - left_samples, 3};
  auto const left_energy = residual_energies(left, problem.candidates());
  auto const right_energy = residual_energies(right, problem.candidates());
  for (std::size_t m = 0; m < 4; ++m) EXPECT_EQ(left_energy[m] + right_energy[m], whole[m]);
}

}  // namespace residual_energy_bits_test
}  // namespace torquescope::kernels
