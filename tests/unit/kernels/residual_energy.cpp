#include "kernels/residual_energy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "unit/kernels/every_instruction_set.hpp"
#include "unit/kernels/random_problem.hpp"

namespace torquescope::kernels {
namespace residual_energy_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class ResidualEnergy : public EveryInstructionSet {};

INSTANTIATE_TEST_SUITE_P(Target, ResidualEnergy, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

long double wide(double number) { return static_cast<long double>(number); }

long double gamma(std::size_t k, long double unit) {
  long double const ku = static_cast<long double>(k) * unit;
  return ku / (1 - ku);
}

struct Reference {
  long double energy = 0;
  long double magnitude = 0;  // sum_i (|tau_i| + sum_r |phi_ir v_mr|)^2
};

Reference plain_loops(RandomProblem const& problem, std::size_t m, long double delta) {
  Reference reference;
  for (std::size_t i = 0; i < problem.n_samples; ++i) {
    long double e = wide(problem.tau[i]), magnitude = std::abs(e);
    for (std::size_t r = 0; r < problem.n_regressors; ++r) {
      long double const product = wide(problem.phi_at(i, r)) * wide(problem.member_at(m, r));
      e -= product;
      magnitude += std::abs(product);
    }
    long double const size = std::abs(e);
    reference.energy += size <= delta ? size * size : delta * (2 * size - delta);
    reference.magnitude += magnitude * magnitude;
  }
  return reference;
}

// the bound of residual_energy.hpp (standard rounding analysis, Higham 2002, chapter 3) for the kernel, and the same
// for the long double loops themselves, which round every product and add one sample after the other
long double error_bound(RandomProblem const& problem, std::size_t summation_depth, Reference const& reference) {
  auto const relative = [](std::size_t residual_depth, std::size_t depth, long double unit) {
    long double const residual = 1 + gamma(residual_depth, unit);
    return residual * residual * (1 + gamma(depth, unit)) - 1;
  };
  std::size_t const n_regressors = problem.n_regressors;
  return reference.magnitude * (relative(n_regressors, summation_depth, std::ldexp(1.0L, -53)) +
                                relative(n_regressors + 1, problem.n_samples + 3, std::ldexp(1.0L, -64)));
}

std::size_t summation_depth(std::size_t n_samples) {
  std::size_t const n_blocks = (n_samples + block_samples - 1) / block_samples;
  return 259 + static_cast<std::size_t>(std::ceil(std::log2(static_cast<double>(n_blocks))));
}

template <class Check>
void for_random_problems(Check const& check) {
  std::mt19937 random(2024);
  auto const between = [&](std::size_t low, std::size_t high) {
    return std::uniform_int_distribution<std::size_t>(low, high)(random);
  };
  for (int repeat = 0; repeat < 25; ++repeat) {
    std::size_t const n_samples = between(1, 5000), n_regressors = between(1, 60);
    // as many members as keep the plain loops within a second
    std::size_t const n_members = std::min(between(1, 40), 1 + 2'000'000 / (n_samples * n_regressors));
    check(RandomProblem(n_samples, n_regressors, n_members, static_cast<std::uint32_t>(random())));
  }
}

TEST_P(ResidualEnergy, EqualsPlainLoopsWithinTheRoundingBound) {
  for_random_problems([](RandomProblem const& problem) {
    auto const energy = residual_energies(problem.tiles(), problem.candidates());
    for (std::size_t m = 0; m < problem.n_members; ++m) {
      auto const reference = plain_loops(problem, m, std::numeric_limits<long double>::infinity());
      long double const bound = error_bound(problem, summation_depth(problem.n_samples), reference);
      ASSERT_LE(std::abs(wide(energy[m]) - reference.energy), bound) << problem.name() << ", member " << m;
    }
  });
}

TEST_P(ResidualEnergy, HuberEqualsPlainLoopsWithinTheRoundingBound) {
  for_random_problems([](RandomProblem const& problem) {
    // about the size of a residual: both branches are taken
    double const delta = std::sqrt(static_cast<double>(problem.n_regressors));
    auto const energy = huber_energies(problem.tiles(), problem.candidates(), delta);
    for (std::size_t m = 0; m < problem.n_members; ++m) {
      auto const reference = plain_loops(problem, m, wide(delta));
      // two more roundings in the loss itself
      long double const bound = error_bound(problem, summation_depth(problem.n_samples) + 2, reference);
      ASSERT_LE(std::abs(wide(energy[m]) - reference.energy), bound) << problem.name() << ", member " << m;
    }
  });
}

TEST_P(ResidualEnergy, TrueParametersOfExactDataLeaveNothing) {
  // small integers: every product and sum is exact
  std::size_t const n = 4321;
  std::vector<double> phi(n * 3), tau(n), members = {2, -3, 5, 2, -3, 6};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t r = 0; r < 3; ++r) phi[r * n + i] = static_cast<double>((i * (r + 7)) % 11) - 5;
    tau[i] = 2 * phi[i] - 3 * phi[n + i] + 5 * phi[2 * n + i];
  }
  AlignedDoubles packed(packed_size(n, 3));
  auto const tiles = pack_tiles(phi.data(), n, tau.data(), n, 3, packed.data());
  auto const energy = residual_energies(tiles, {members.data(), 2, 3});
  double off_by_column = 0;
  for (std::size_t i = 0; i < n; ++i) off_by_column += phi[2 * n + i] * phi[2 * n + i];
  EXPECT_EQ(energy[0], 0.0);
  EXPECT_EQ(energy[1], off_by_column);
}

TEST_P(ResidualEnergy, HuberGrowsLinearlyWithAnOutlier) {
  double const tau[] = {0.5, -1000.0};
  AlignedDoubles packed(packed_size(2, 0));
  auto const tiles = pack_tiles(nullptr, 0, tau, 2, 0, packed.data());
  EXPECT_EQ(huber_energies(tiles, {nullptr, 1, 0}, 2.0).front(), 0.25 + 2.0 * (2000.0 - 2.0));
}

TEST_P(ResidualEnergy, NotANumberStaysWithItsMember) {
  RandomProblem problem(100, 4, 8, 3);
  auto const before = residual_energies(problem.tiles(), problem.candidates());
  auto const huber_before = huber_energies(problem.tiles(), problem.candidates(), 1.0);
  problem.members[2 * problem.member_stride + 1] = nan;
  auto const after = residual_energies(problem.tiles(), problem.candidates());
  auto const huber_after = huber_energies(problem.tiles(), problem.candidates(), 1.0);
  for (std::size_t m = 0; m < 8; ++m) {
    if (m == 2) {
      EXPECT_TRUE(std::isnan(after[m]));
      EXPECT_TRUE(std::isnan(huber_after[m]));
    } else {
      EXPECT_EQ(after[m], before[m]);
      EXPECT_EQ(huber_after[m], huber_before[m]);
    }
  }
}

TEST_P(ResidualEnergy, InfiniteParametersGiveNoFiniteEnergy) {
  RandomProblem problem(100, 4, 2, 3);
  problem.members[0] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(std::isfinite(residual_energies(problem.tiles(), problem.candidates())[0]));
  EXPECT_FALSE(std::isfinite(huber_energies(problem.tiles(), problem.candidates(), 1.0)[0]));
}

TEST_P(ResidualEnergy, NothingInNothingOut) {
  RandomProblem const no_samples(0, 3, 7, 1);
  EXPECT_EQ(residual_energies(no_samples.tiles(), no_samples.candidates()), std::vector<double>(7, 0.0));
  RandomProblem const no_members(40, 3, 0, 1);
  EXPECT_TRUE(residual_energies(no_members.tiles(), no_members.candidates()).empty());
  RandomProblem const no_regressors(64, 0, 2, 1);
  auto const energy = residual_energies(no_regressors.tiles(), no_regressors.candidates());
  auto const reference = plain_loops(no_regressors, 0, std::numeric_limits<long double>::infinity());
  EXPECT_NEAR(energy[0], static_cast<double>(reference.energy), 1e-13 * energy[0]);
  EXPECT_EQ(energy[0], energy[1]);
}

TEST_P(ResidualEnergy, ThreadsShareOneRecording) {
  RandomProblem const problem(3000, 5, 16, 6);
  auto const expected = residual_energies(problem.tiles(), problem.candidates());
  std::vector<double> energy(16);
  auto const evaluate = [&](std::size_t first, std::size_t count) {
    auto const part = problem.candidates(first, count);
    auto workspace = workspace_for(problem.tiles(), part);
    residual_energy(problem.tiles(), part, energy.data() + first, workspace.data());
  };
  std::thread other(evaluate, 0, 7);
  evaluate(7, 9);
  other.join();
  EXPECT_EQ(energy, expected);
}

}  // namespace residual_energy_test
}  // namespace torquescope::kernels
