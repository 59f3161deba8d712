// Residuals and their sums on every instruction set: the documented order of addition, bit by bit.

#include "kernels/residual_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::kernels {
namespace {

std::vector<double> numbers(std::size_t n, double phase) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = std::sin(phase + 1.3 * static_cast<double>(i * i % 1009));
  return x;
}

double documented_sum(std::vector<double> const& x) {
  std::size_t const n = x.size(), whole = n / 4 * 4;
  if (n == 0) return 0.0;
  if (n == 1) return x[0];
  double even = x[0], odd = x[1];
  if (n >= 4) {
    double apart[4] = {x[0], x[1], x[2], x[3]};
    for (std::size_t i = 4; i < whole; ++i) apart[i % 4] += x[i];
    even = apart[0] + apart[2];
    odd = apart[1] + apart[3];
    if (n - whole >= 2) {
      even += x[whole];
      odd += x[whole + 1];
    }
  }
  double const both = even + odd;
  return n % 2 == 1 ? both + x[n - 1] : both;
}

class ResidualMoments : public EveryInstructionSet {};

TEST_P(ResidualMoments, AreSummedInTheDocumentedOrderWhateverTheCompany) {
  for (std::size_t n : {1, 2, 3, 4, 5, 6, 7, 8, 9, 100, 103})
    for (std::size_t R : {1, 2, 5})
      for (std::size_t n_candidates : {1, 3, 4, 6}) {
        std::size_t const leading_dimension = n + 3;
        auto const phi = numbers(leading_dimension * R, 0.1), tau = numbers(n, 0.7), x = numbers(R * n_candidates, 0.4);
        std::vector<double> residuals(n_candidates * n);
        std::vector<ResidualSums> sums(n_candidates);
        residual_sums({phi.data(), leading_dimension, tau.data(), n, R}, x.data(), n_candidates, residuals.data(),
                      sums.data());
        for (std::size_t c = 0; c < n_candidates; ++c) {
          std::vector<double> residual(n), square(n), about(n);
          double const centre = 0.123;
          for (std::size_t t = 0; t < n; ++t) {
            double predicted = phi[t] * x[c * R];
            for (std::size_t r = 1; r < R; ++r) predicted = phi[t + r * leading_dimension] * x[c * R + r] + predicted;
            residual[t] = tau[t] - predicted;
            square[t] = residual[t] * residual[t];
            about[t] = (residual[t] - centre) * (residual[t] - centre);
            ASSERT_EQ(residuals[c * n + t], residual[t]);
          }
          ASSERT_EQ(sums[c].sum, documented_sum(residual)) << n << " rows, candidate " << c << " of " << n_candidates;
          ASSERT_EQ(sums[c].squares, documented_sum(square)) << n << " rows";
          ASSERT_EQ(squares_about(residual.data(), n, centre), documented_sum(about)) << n << " rows";
        }
      }
}

INSTANTIATE_TEST_SUITE_P(Target, ResidualMoments, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

}  // namespace
}  // namespace torquescope::kernels
