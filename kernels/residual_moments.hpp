#pragma once
// Residuals of several candidates at once, their sum and sums of squares: all that a table of results says of a run.
//
// Equation   e_t = (tau_t - phi_t1 x_1) - phi_t2 x_2 - ...;  squares = sum e_t^2, sum = sum e_t;
//            squares_about = sum (e_t - centre)^2
// Shapes     samples as in gram.hpp; parameters: n_candidates x R; residuals: n_candidates x n_samples, both row-major
// Bits       the same on every instruction set and for any company of candidates: one rounding per multiply-add; a sum
//            adds up rows t mod 8 apart, then ((0+4)+(2+6)) + ((1+5)+(3+7))
// Speed      samples (a block of some thousand rows) should fit into the L2 cache: they are read for every four
//            candidates
// Threads    free functions; do not allocate

#include <cstddef>

#include "kernels/gram.hpp"

namespace torquescope::kernels {

struct ResidualSums {
  double sum = 0.0, squares = 0.0;
};

// sums: n_candidates
void residual_sums(SampleColumns const& samples, double const* parameters, std::size_t n_candidates, double* residuals,
                   ResidualSums* sums);

double squares_about(double const* residuals, std::size_t n_samples, double centre);

}  // namespace torquescope::kernels
