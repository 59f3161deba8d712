#pragma once
// All inner products of the columns of two matrices: the coefficients of a projection.
//
// Equation   out = A' B
// Shapes     A: n x n_a, B: n x n_b, column-major; a column begins `stride` >= n numbers after the one before.
//            out: n_a x n_b, column-major without gaps
// Bits       the same on every instruction set and for any company of columns: lane l of a product sums rows l, l + 8,
//            ... in order, one rounding each, then sum_lanes()
// Speed      `a` should fit into the L2 cache (40 columns of 6000 rows): it is read once for every four columns of `b`
// Threads    free function; does not allocate

#include <cstddef>

namespace torquescope::kernels {

struct Columns {
  double const* first;
  std::size_t count, stride;
};

void column_products(Columns a, Columns b, std::size_t n, double* out);

}  // namespace torquescope::kernels
