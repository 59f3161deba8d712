// the float32 energy: one documented order of operations on every instruction set, and the error its header promises
#include "kernels/float_energy.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "unit/kernels/documented_sum.hpp"
#include "unit/kernels/every_instruction_set.hpp"
#include "unit/kernels/random_problem.hpp"

namespace torquescope::kernels {
namespace float_energy_test {

class FloatEnergyTargets : public EveryInstructionSet {};

INSTANTIATE_TEST_SUITE_P(Target, FloatEnergyTargets, testing::ValuesIn(supported_instruction_sets()),
                         instruction_set_of);

std::vector<double> float_energies(RandomProblem const& problem, Candidates const& candidates) {
  AlignedFloats packed(packed_size<float>(problem.n_samples, problem.n_regressors));
  auto const tiles = pack_tiles(problem.phi.data(), problem.phi_stride, problem.tau.data(), problem.n_samples,
                                problem.n_regressors, packed.data());
  std::vector<float> workspace(float_workspace_size(problem.n_regressors, candidates.n_members));
  std::vector<double> sums(float_sums_size(problem.n_samples, candidates.n_members)), energy(candidates.n_members);
  float_residual_energy(tiles, candidates, energy.data(), workspace.data(), sums.data());
  return energy;
}

// the order written in float_energy.hpp, one operation after the other
double energy_in_documented_order(RandomProblem const& problem, std::size_t m) {
  std::vector<double> blocks;
  for (std::size_t first = 0; first < problem.n_samples; first += 2048) {
    std::array<float, 16> lane{};
    for (std::size_t i = first; i < std::min(first + 2048, problem.n_samples); ++i) {
      auto e = static_cast<float>(problem.tau[i]);
      for (std::size_t r = 0; r < problem.n_regressors; ++r)
        e = std::fma(-static_cast<float>(problem.phi_at(i, r)), static_cast<float>(problem.member_at(m, r)), e);
      lane[i % 16] = std::fma(e, e, lane[i % 16]);
    }
    std::array<double, 8> fold;
    for (std::size_t l = 0; l < 8; ++l) fold[l] = static_cast<double>(lane[l]) + static_cast<double>(lane[l + 8]);
    blocks.push_back(sum_of_lanes(fold));
  }
  return sum_of_blocks(std::move(blocks));
}

TEST_P(FloatEnergyTargets, SumsSquaresOfFloatsInTheDocumentedOrder) {
  struct Size {
    std::size_t n_samples, n_regressors, n_members;
  };
  // tails of vectors, tiles and blocks, tails of groups, seven blocks
  constexpr Size sizes[] = {{1, 1, 1},     {15, 4, 2},    {63, 3, 5},     {64, 4, 6},    {65, 4, 7},
                            {257, 24, 13}, {2048, 11, 6}, {2049, 11, 11}, {14000, 2, 2}, {700, 60, 9}};
  std::uint32_t seed = 300;
  for (auto const& size : sizes) {
    RandomProblem const problem(size.n_samples, size.n_regressors, size.n_members, ++seed);
    auto const energy = float_energies(problem, problem.candidates());
    for (std::size_t m = 0; m < size.n_members; ++m)
      ASSERT_EQ(energy[m], energy_in_documented_order(problem, m)) << problem.name() << ", member " << m;
  }
}

TEST_P(FloatEnergyTargets, GivesTheSameFloatBitsForEveryGroupingOfMembers) {
  RandomProblem const problem(2500, 9, 23, 5);
  auto const together = float_energies(problem, problem.candidates());
  for (std::size_t chunk : {1, 5, 7}) {
    for (std::size_t first = 0; first < problem.n_members; first += chunk) {
      std::size_t const count = std::min(chunk, problem.n_members - first);
      auto const apart = float_energies(problem, problem.candidates(first, count));
      for (std::size_t m = 0; m < count; ++m) ASSERT_EQ(apart[m], together[first + m]) << "chunks of " << chunk;
    }
  }
}

// tau = phi v + noise: the smaller the noise, the more of the residual is rounding
TEST(FloatEnergy, IsOffByItsRoundingOverTheNoise) {
  for (double const noise : {1e-1, 1e-2, 1e-3}) {
    RandomProblem problem(20000, 4, 6, 17);
    double torque = 0.0;
    for (std::size_t i = 0; i < problem.n_samples; ++i) {
      double prediction = 0.0;
      for (std::size_t r = 0; r < 4; ++r) prediction += problem.phi_at(i, r) * problem.member_at(0, r);
      problem.tau[i] = prediction + noise * problem.tau[i];
      torque += prediction * prediction;
    }
    pack_tiles(problem.phi.data(), problem.phi_stride, problem.tau.data(), problem.n_samples, 4, problem.packed.data());
    double const exact = residual_energies(problem.tiles(), problem.candidates(0, 1))[0];
    double const share = std::sqrt(exact / torque);
    double const single = float_energies(problem, problem.candidates(0, 1))[0];
    // independent roundings of 2^-24 average out over the samples; sums within a block do not quite
    EXPECT_NEAR(single, exact, (3e-7 + 0x1p-24 / share) * exact) << share;
    EXPECT_NE(single, exact);
  }
}

}  // namespace float_energy_test
}  // namespace torquescope::kernels
