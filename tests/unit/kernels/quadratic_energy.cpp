// The quadratic form against long double loops; the documented order of operations, on every instruction set.
#include "kernels/quadratic_energy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "unit/kernels/every_instruction_set.hpp"
#include "unit/kernels/random_problem.hpp"

namespace torquescope::kernels {
namespace quadratic_energy_test {

class QuadraticEnergy : public EveryInstructionSet {};

INSTANTIATE_TEST_SUITE_P(Target, QuadraticEnergy, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

struct RandomForm {
  std::size_t n;
  RandomProblem numbers;  // n x n, and members
  RandomForm(std::size_t n_regressors, std::size_t n_members, std::uint32_t seed)
      : n(n_regressors), numbers(n_regressors + 2, n_regressors, n_members, seed) {}

  // what the root may have lost: some 1e-17 of it
  std::vector<double> root_low() const {
    auto low = root();
    std::reverse(low.begin(), low.end());
    for (auto& x : low) x = std::ldexp(x, -54);
    return low;
  }
  // columns of numbers.phi are at least n + 2 apart: rows 0 .. n-1 of the root come from its beginning
  std::vector<double> root() const { return {numbers.phi.begin(), numbers.phi.begin() + static_cast<long>(n * n)}; }
};

std::vector<double> energies(QuadraticForm const& form, Candidates const& candidates) {
  std::vector<double> energy(candidates.n_members);
  AlignedDoubles workspace(quadratic_workspace_size(form.n_regressors));
  quadratic_energy(form, candidates, energy.data(), workspace.data());
  return energy;
}

double in_documented_order(QuadraticForm const& form, double const* member) {
  std::size_t const n = form.n_regressors;
  double squares = 0, slope = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0, error = 0;
    for (std::size_t j = i; j < n; ++j) {
      double const v = member[j], c = form.centre[j], high = v - c, back = high - v;
      double const low = (v - (high - back)) - (c + back);
      double const root = form.root[i * n + j], product = root * high;
      double const total = sum + product, came = total - sum;
      error += std::fma(root, high, -product) + ((sum - (total - came)) + (product - came));
      error = std::fma(form.root_low[i * n + j], high, std::fma(root, low, error));
      sum = total;
    }
    squares = std::fma(sum + error, sum + error, squares);
  }
  for (std::size_t j = 0; j < n; ++j) slope = std::fma(form.slope[j], member[j] - form.centre[j], slope);
  return form.constant + std::fma(-2.0, slope, squares);
}

TEST_P(QuadraticEnergy, HasTheDocumentedOrderAndEqualsPlainLoops) {
  std::uint32_t seed = 0;
  for (std::size_t n : {1, 2, 4, 11, 60}) {
    for (std::size_t n_members : {1, 7, 8, 9, 30}) {
      RandomForm const random(n, n_members, ++seed);
      auto const root = random.root(), low = random.root_low();
      QuadraticForm const form{n,          random.numbers.tau.data(),     root.data(),
                               low.data(), random.numbers.tau.data() + 1, 3.5};
      auto const candidates = random.numbers.candidates();
      auto const energy = energies(form, candidates);
      for (std::size_t m = 0; m < n_members; ++m) {
        double const* const member = candidates.data + m * candidates.leading_dimension;
        ASSERT_EQ(energy[m], in_documented_order(form, member)) << "R = " << n << ", member " << m;
        long double exact = 3.5L, magnitude = 3.5L, rough = 0.0L;
        for (std::size_t i = 0; i < n; ++i) {
          auto const step = [&](std::size_t j) {
            return static_cast<long double>(member[j]) - static_cast<long double>(form.centre[j]);
          };
          long double sum = 0, size = 0;
          for (std::size_t j = i; j < n; ++j) {
            long double const exact_root =
                static_cast<long double>(root[i * n + j]) + static_cast<long double>(low[i * n + j]);
            sum += exact_root * step(j);
            size += std::abs(exact_root * step(j));
          }
          exact += sum * sum - 2 * static_cast<long double>(form.slope[i]) * step(i);
          // the long double sums round in their 64 bits, ours as if in 106
          rough += 2 * size * size;
          magnitude += sum * sum + 2 * std::abs(static_cast<long double>(form.slope[i]) * step(i));
        }
        // one rounding per operation: 2 in a row's square, R in the sum of squares and in the slope, 4 to the end
        auto const count = static_cast<long double>(n);
        long double const bound = (count + 6) * 0x1p-53L * magnitude + (count + 2) * 0x1p-64L * rough;
        ASSERT_LE(std::abs(static_cast<long double>(energy[m]) - exact), bound) << "R = " << n << ", member " << m;
      }
    }
  }
}

TEST_P(QuadraticEnergy, NotANumberStaysWithItsMember) {
  RandomForm random(4, 10, 5);
  auto const root = random.root(), low = random.root_low();
  QuadraticForm const form{4, random.numbers.tau.data(), root.data(), low.data(), random.numbers.tau.data() + 1, 1.0};
  auto const before = energies(form, random.numbers.candidates());
  random.numbers.members[3 * random.numbers.member_stride + 2] = std::numeric_limits<double>::quiet_NaN();
  random.numbers.members[9 * random.numbers.member_stride] = std::numeric_limits<double>::infinity();
  auto const after = energies(form, random.numbers.candidates());
  for (std::size_t m = 0; m < 10; ++m) {
    if (m == 3 || m == 9) {
      EXPECT_FALSE(std::isfinite(after[m]));
    } else {
      EXPECT_EQ(after[m], before[m]);
    }
  }
}

}  // namespace quadratic_energy_test
}  // namespace torquescope::kernels
