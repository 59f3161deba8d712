// Residuals and their sums on every instruction set: the documented order of addition, bit by bit.

#include "kernels/residual_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::kernels {
namespace residual_moments_test {

std::vector<double> numbers(std::size_t n, double phase) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = std::sin(phase + 1.3 * static_cast<double>(i * i % 1009));
  return x;
}

double lanes_added(double const (&lane)[8]) {
  return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

double documented_sum(std::vector<double> const& x) {
  double lane[8] = {};
  for (std::size_t t = 0; t < x.size(); ++t) lane[t % 8] += x[t];
  return lanes_added(lane);
}

double documented_squares(std::vector<double> const& x) {
  double lane[8] = {};
  for (std::size_t t = 0; t < x.size(); ++t) lane[t % 8] = std::fma(x[t], x[t], lane[t % 8]);
  return lanes_added(lane);
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
          std::vector<double> residual(n), about(n);
          double const centre = 0.123;
          for (std::size_t t = 0; t < n; ++t) {
            residual[t] = tau[t];
            for (std::size_t r = 0; r < R; ++r)
              residual[t] = std::fma(-phi[t + r * leading_dimension], x[c * R + r], residual[t]);
            about[t] = residual[t] - centre;
            ASSERT_EQ(residuals[c * n + t], residual[t]);
          }
          ASSERT_EQ(sums[c].sum, documented_sum(residual)) << n << " rows, candidate " << c << " of " << n_candidates;
          ASSERT_EQ(sums[c].squares, documented_squares(residual)) << n << " rows";
          ASSERT_EQ(squares_about(residual.data(), n, centre), documented_squares(about)) << n << " rows";
        }
      }
}

INSTANTIATE_TEST_SUITE_P(Target, ResidualMoments, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

}  // namespace residual_moments_test
}  // namespace torquescope::kernels
