// Sums of products against long double loops; the documented order of operations, on every instruction set.
#include "kernels/gram.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "unit/kernels/documented_sum.hpp"
#include "unit/kernels/every_instruction_set.hpp"
#include "unit/kernels/random_problem.hpp"

namespace torquescope::kernels {
namespace gram_test {

class Gram : public EveryInstructionSet {};

INSTANTIATE_TEST_SUITE_P(Target, Gram, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

SampleColumns columns_of(RandomProblem const& problem) {
  return {problem.phi.data(), problem.phi_stride, problem.tau.data(), problem.n_samples, problem.n_regressors};
}

std::vector<double> gram_of(SampleColumns const& samples) {
  std::vector<double> sums((samples.n_regressors + 1) * (samples.n_regressors + 1), -1.0);
  AlignedDoubles workspace(gram_workspace_size(samples.n_samples, samples.n_regressors));
  gram(samples, sums.data(), workspace.data());
  return sums;
}

std::vector<double> whitened_gram_of(SampleColumns const& samples, std::vector<double> const& root,
                                     std::vector<double> const& centre) {
  std::vector<double> sums((samples.n_regressors + 1) * (samples.n_regressors + 1), -1.0);
  AlignedDoubles workspace(gram_workspace_size(samples.n_samples, samples.n_regressors));
  whitened_gram(samples, root.data(), centre.data(), sums.data(), workspace.data());
  return sums;
}

double column(RandomProblem const& problem, std::size_t t, std::size_t r) {
  return r < problem.n_regressors ? problem.phi_at(t, r) : problem.tau[t];
}

struct Size {
  std::size_t n_samples, n_regressors;
};
// tails of vectors, tiles, chunks, blocks; squares of pairs that are full, ragged, one row
constexpr Size sizes[] = {{1, 1},    {5, 0},     {7, 4},     {32, 3},    {255, 2},  {256, 7}, {257, 4},
                          {2048, 5}, {2049, 11}, {14000, 4}, {2500, 24}, {300, 60}, {0, 3}};

TEST_P(Gram, EqualsPlainLoopsWithinTheRoundingBound) {
  std::uint32_t seed = 300;
  for (auto const& size : sizes) {
    RandomProblem const problem(size.n_samples, size.n_regressors, 1, ++seed);
    auto const sums = gram_of(columns_of(problem));
    std::size_t const n_rows = size.n_regressors + 1;
    // as the bound of residual_energy.hpp; the depth of a tree of at most 7 blocks
    long double const unit = std::ldexp(1.0L, -53), bound = (259 + 3) * unit / (1 - (259 + 3) * unit);
    for (std::size_t i = 0; i < n_rows; ++i) {
      for (std::size_t j = 0; j < n_rows; ++j) {
        long double sum = 0, magnitude = 0;
        for (std::size_t t = 0; t < size.n_samples; ++t) {
          long double const product =
              static_cast<long double>(column(problem, t, i)) * static_cast<long double>(column(problem, t, j));
          sum += product;
          magnitude += std::abs(product);
        }
        ASSERT_LE(std::abs(static_cast<long double>(sums[i * n_rows + j]) - sum), bound * magnitude * 1.001L)
            << problem.name() << ", " << i << " " << j;
        ASSERT_EQ(sums[i * n_rows + j], sums[j * n_rows + i]);
      }
    }
  }
}

double product_in_documented_order(RandomProblem const& problem, std::size_t i, std::size_t j) {
  std::vector<double> blocks;
  for (std::size_t first = 0; first < problem.n_samples; first += 2048) {
    std::array<double, 8> lane{};
    for (std::size_t t = first; t < std::min(first + 2048, problem.n_samples); ++t)
      lane[t % 8] = std::fma(column(problem, t, i), column(problem, t, j), lane[t % 8]);
    blocks.push_back(sum_of_lanes(lane));
  }
  return sum_of_blocks(std::move(blocks));
}

TEST_P(Gram, SumsProductsInTheDocumentedOrder) {
  std::uint32_t seed = 400;
  for (auto const& size : sizes) {
    RandomProblem const problem(size.n_samples, size.n_regressors, 1, ++seed);
    auto const sums = gram_of(columns_of(problem));
    std::size_t const n_rows = size.n_regressors + 1;
    for (std::size_t i = 0; i < n_rows; ++i)
      for (std::size_t j = i; j < n_rows; ++j)
        ASSERT_EQ(sums[i * n_rows + j], product_in_documented_order(problem, i, j)) << problem.name();
  }
}

// upper triangular, diagonal away from zero
std::vector<double> some_root(std::size_t n) {
  std::vector<double> root(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j)
      root[i * n + j] = i == j ? 1.5 + 0.1 * static_cast<double>(i) : 0.3 - 0.05 * static_cast<double>(i + j);
  return root;
}

TEST_P(Gram, WhitenedIsTheGramOfTheWhitenedRows) {
  for (std::size_t n_samples : {31, 300, 2100}) {
    std::size_t const n = 5;
    RandomProblem problem(n_samples, n, 1, 17);
    auto const root = some_root(n);
    std::vector<double> const centre{0.5, -0.25, 1.0, 2.0, -0.75};
    auto const sums = whitened_gram_of(columns_of(problem), root, centre);

    RandomProblem white = problem;
    for (std::size_t t = 0; t < n_samples; ++t) {
      double e = problem.tau[t];
      for (std::size_t r = 0; r < n; ++r) e = std::fma(-problem.phi_at(t, r), centre[r], e);
      white.tau[t] = e;
      for (std::size_t r = 0; r < n; ++r) {
        double q = problem.phi_at(t, r);
        for (std::size_t s = 0; s < r; ++s) q = std::fma(-white.phi_at(t, s), root[s * n + r], q);
        white.phi[r * white.phi_stride + t] = q / root[r * n + r];
      }
    }
    EXPECT_EQ(sums, gram_of(columns_of(white)));
  }
}

TEST_P(Gram, WritesOnlySumsAndWorkspace) {
  for (std::size_t n_regressors : {1, 4, 7, 12}) {
    RandomProblem const problem(5000, n_regressors, 1, 4);
    std::size_t const size = gram_workspace_size(5000, n_regressors), n_sums = (n_regressors + 1) * (n_regressors + 1);
    double const guard = 12345.0;
    AlignedDoubles workspace(size + 64, guard);
    std::vector<double> sums(n_sums + 64, guard);
    gram(columns_of(problem), sums.data(), workspace.data());
    for (std::size_t i = 0; i < 64; ++i) {
      EXPECT_EQ(workspace[size + i], guard);
      EXPECT_EQ(sums[n_sums + i], guard);
    }
  }
}

}  // namespace gram_test
}  // namespace torquescope::kernels
