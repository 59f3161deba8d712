// Sorting by the columns that take few values changes the order of the sum, nothing else.
#include "kernels/levelled_energy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "unit/kernels/every_instruction_set.hpp"
#include "unit/kernels/random_problem.hpp"

namespace torquescope::kernels {
namespace levelled_energy_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

class LevelledEnergyTargets : public EveryInstructionSet {};

INSTANTIATE_TEST_SUITE_P(Target, LevelledEnergyTargets, testing::ValuesIn(supported_instruction_sets()),
                         instruction_set_of);

// runs of samples in which the last n_constant columns keep one value; the samples behind the last whole tile are
// `rest`
struct LevelledProblem {
  std::size_t n_varying, n_constant, n_members;
  std::vector<std::size_t> run_tiles, run_end, constant_column, varying_column;
  std::vector<double> level;
  RandomProblem varying, rest;

  LevelledProblem(std::vector<std::size_t> tiles_of_runs, std::size_t n_v, std::size_t n_c, std::size_t n_m,
                  std::size_t n_rest, std::uint32_t seed)
      : n_varying(n_v),
        n_constant(n_c),
        n_members(n_m),
        run_tiles(std::move(tiles_of_runs)),
        varying(total() * tile_samples, n_v, n_m, seed),
        rest(n_rest, n_v + n_c, n_m, seed + 1) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::size_t end = 0;
    for (std::size_t tiles : run_tiles) {
      run_end.push_back(end += tiles);
      for (std::size_t k = 0; k < n_constant; ++k) level.push_back(normal(random));
    }
    // constant columns first: the order of parameters is not the order of columns in a tile
    for (std::size_t k = 0; k < n_constant; ++k) constant_column.push_back(k);
    for (std::size_t r = 0; r < n_varying; ++r) varying_column.push_back(n_constant + r);
  }

  std::size_t total() const {
    std::size_t sum = 0;
    for (std::size_t tiles : run_tiles) sum += tiles;
    return sum;
  }
  LevelledTiles tiles() const {
    return {varying.tiles(), rest.tiles(), run_end.size(),         run_end.data(),
            level.data(),    n_constant,   constant_column.data(), varying_column.data()};
  }
  // members of `rest` have all parameters
  Candidates candidates() const { return rest.candidates(); }
  Candidates candidates(std::size_t first, std::size_t count) const { return rest.candidates(first, count); }
};

std::vector<double> energies(LevelledTiles const& tiles, Candidates const& candidates, double delta) {
  std::vector<double> energy(candidates.n_members);
  AlignedDoubles workspace(levelled_workspace_size(tiles, candidates.n_members));
  if (delta < infinity)
    levelled_huber_energy(tiles, candidates, delta, energy.data(), workspace.data());
  else
    levelled_residual_energy(tiles, candidates, energy.data(), workspace.data());
  return energy;
}

struct Reference {
  long double energy = 0, magnitude = 0;  // magnitude: sum_i (|tau_i| + sum_r |phi_ir v_mr|)^2
};

void add_sample(Reference& reference, double tau, std::vector<double> const& row, double const* member,
                long double delta) {
  long double e = static_cast<long double>(tau), magnitude = std::abs(e);
  for (std::size_t r = 0; r < row.size(); ++r) {
    long double const product = static_cast<long double>(row[r]) * static_cast<long double>(member[r]);
    e -= product;
    magnitude += std::abs(product);
  }
  long double const size = std::abs(e);
  reference.energy += size <= delta ? size * size : delta * (2 * size - delta);
  reference.magnitude += magnitude * magnitude;
}

Reference plain_loops(LevelledProblem const& problem, std::size_t m, double delta) {
  Reference reference;
  double const* const member = problem.rest.members.data() + m * problem.rest.member_stride;
  std::vector<double> row(problem.n_constant + problem.n_varying);
  std::size_t run = 0;
  for (std::size_t i = 0; i < problem.varying.n_samples; ++i) {
    while (i >= problem.run_end[run] * tile_samples) ++run;
    for (std::size_t k = 0; k < problem.n_constant; ++k) row[k] = problem.level[run * problem.n_constant + k];
    for (std::size_t r = 0; r < problem.n_varying; ++r) row[problem.n_constant + r] = problem.varying.phi_at(i, r);
    add_sample(reference, problem.varying.tau[i], row, member, static_cast<long double>(delta));
  }
  for (std::size_t i = 0; i < problem.rest.n_samples; ++i) {
    for (std::size_t r = 0; r < row.size(); ++r) row[r] = problem.rest.phi_at(i, r);
    add_sample(reference, problem.rest.tau[i], row, member, static_cast<long double>(delta));
  }
  return reference;
}

long double gamma(std::size_t k, long double unit) {
  return static_cast<long double>(k) * unit / (1 - static_cast<long double>(k) * unit);
}

// the bound of levelled_energy.hpp and that of the long double loops
long double error_bound(LevelledProblem const& problem, Reference const& reference) {
  auto const relative = [](std::size_t residual_depth, std::size_t depth, long double unit) {
    long double const residual = 1 + gamma(residual_depth, unit);
    return residual * residual * (1 + gamma(depth, unit)) - 1;
  };
  std::size_t const n_regressors = problem.n_constant + problem.n_varying;
  std::size_t const n_samples = problem.varying.n_samples + problem.rest.n_samples;
  // the constant is rounded once more than a column: its subtraction. Blocks: a run begins a new one
  std::size_t const blocks = n_samples / block_samples + problem.run_tiles.size() + 2;
  std::size_t const depth = 261 + static_cast<std::size_t>(std::ceil(std::log2(static_cast<double>(blocks))));
  return reference.magnitude * (relative(n_regressors + 1, depth, std::ldexp(1.0L, -53)) +
                                relative(n_regressors + 1, n_samples + 3, std::ldexp(1.0L, -64)));
}

// one run, many runs, an empty one, runs of more than a block, no varying column, no rest, groups that are not full
std::vector<LevelledProblem> problems() {
  return {{{3}, 2, 2, 5, 10, 1},    {{1, 2, 1}, 2, 2, 6, 31, 2}, {{65, 0, 130}, 2, 2, 30, 1, 3},
          {{7, 9}, 0, 3, 4, 20, 4}, {{64, 64}, 5, 1, 7, 0, 5},   {{2, 2, 2, 2}, 11, 3, 13, 64, 6},
          {{}, 2, 2, 3, 50, 7}};
}

TEST_P(LevelledEnergyTargets, EqualsPlainLoopsWithinTheRoundingBound) {
  for (auto const& problem : problems()) {
    for (double const delta : {infinity, 1.5}) {
      auto const energy = energies(problem.tiles(), problem.candidates(), delta);
      for (std::size_t m = 0; m < problem.n_members; ++m) {
        auto const reference = plain_loops(problem, m, delta);
        ASSERT_LE(std::abs(static_cast<long double>(energy[m]) - reference.energy), error_bound(problem, reference))
            << problem.rest.name() << ", member " << m << ", delta " << delta;
      }
    }
  }
}

TEST_P(LevelledEnergyTargets, GivesTheSameBitsForEveryGroupingOfMembers) {
  LevelledProblem const problem({3, 70, 5}, 2, 2, 23, 17, 9);
  auto const together = energies(problem.tiles(), problem.candidates(), infinity);
  for (std::size_t chunk : {1, 5, 6, 7, 22}) {
    for (std::size_t first = 0; first < problem.n_members; first += chunk) {
      std::size_t const count = std::min(chunk, problem.n_members - first);
      auto const apart = energies(problem.tiles(), problem.candidates(first, count), infinity);
      for (std::size_t m = 0; m < count; ++m) ASSERT_EQ(apart[m], together[first + m]) << "chunks of " << chunk;
    }
  }
}

TEST_P(LevelledEnergyTargets, NotANumberStaysWithItsMember) {
  LevelledProblem problem({3, 4}, 2, 2, 8, 5, 3);
  auto const before = energies(problem.tiles(), problem.candidates(), infinity);
  // of a constant column
  problem.rest.members[2 * problem.rest.member_stride] = std::numeric_limits<double>::quiet_NaN();
  auto const after = energies(problem.tiles(), problem.candidates(), infinity);
  for (std::size_t m = 0; m < 8; ++m) {
    if (m == 2) {
      EXPECT_TRUE(std::isnan(after[m]));
    } else {
      EXPECT_EQ(after[m], before[m]);
    }
  }
}

TEST_P(LevelledEnergyTargets, HuberWithInfiniteDeltaIsResidualEnergy) {
  LevelledProblem const problem({30, 40}, 3, 2, 8, 25, 8);
  std::vector<double> huber(8);
  AlignedDoubles workspace(levelled_workspace_size(problem.tiles(), 8));
  levelled_huber_energy(problem.tiles(), problem.candidates(), infinity, huber.data(), workspace.data());
  EXPECT_EQ(huber, energies(problem.tiles(), problem.candidates(), infinity));
}

TEST_P(LevelledEnergyTargets, WritesOnlyEnergyAndWorkspace) {
  LevelledProblem const problem({30, 100}, 3, 2, 11, 25, 8);
  std::size_t const size = levelled_workspace_size(problem.tiles(), 11);
  double const guard = 12345.0;
  AlignedDoubles workspace(size + 64, guard);
  std::vector<double> energy(11 + 64, guard);
  levelled_residual_energy(problem.tiles(), problem.candidates(), energy.data(), workspace.data());
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_EQ(workspace[size + i], guard);
    EXPECT_EQ(energy[11 + i], guard);
  }
}

TEST(LevelledEnergy, GivesTheSameBitsOnEveryInstructionSet) {
  LevelledProblem const problem({65, 3, 130}, 2, 2, 30, 29, 12);
  std::set<std::vector<double>> squares, huber;
  for (auto const name : supported_instruction_sets()) {
    ASSERT_TRUE(force_instruction_set(name));
    squares.insert(energies(problem.tiles(), problem.candidates(), infinity));
    huber.insert(energies(problem.tiles(), problem.candidates(), 0.8));
  }
  release_instruction_set();
  EXPECT_EQ(squares.size(), 1u);
  EXPECT_EQ(huber.size(), 1u);
}

}  // namespace levelled_energy_test
}  // namespace torquescope::kernels
