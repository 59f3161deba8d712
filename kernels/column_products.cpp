#include "kernels/column_products.hpp"

#include <algorithm>
#include <cstddef>

#include "kernels/dispatch-inl.hpp"
#include "kernels/lane_sum.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/column_products.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/double_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace {

// 4 x 4 sums of AVX-512 fill half of its registers; AVX2 takes two vectors for a sum and has half of the registers
inline constexpr std::size_t tile = n_vectors == 1 ? 4 : 2;

// n_a_here <= tile columns of a against n_b_here <= tile of b
template <std::size_t n_a_here, std::size_t n_b_here>
HWY_INLINE void add_products(double const* HWY_RESTRICT a, std::size_t a_stride, double const* HWY_RESTRICT b,
                             std::size_t b_stride, std::size_t n, double* HWY_RESTRICT out, std::size_t n_a) {
  V sum[n_a_here][n_b_here][n_vectors];
  for (std::size_t i = 0; i < n_a_here; ++i)
    for (std::size_t j = 0; j < n_b_here; ++j)
      for (std::size_t v = 0; v < n_vectors; ++v) sum[i][j][v] = hn::Zero(d);

  auto const add = [&](double const* const* x, double const* const* y, std::size_t row) {
    for (std::size_t v = 0; v < n_vectors; ++v) {
      V of_b[n_b_here];
      for (std::size_t j = 0; j < n_b_here; ++j) of_b[j] = hn::LoadU(d, y[j] + row + v * vector_lanes);
      for (std::size_t i = 0; i < n_a_here; ++i) {
        V const of_a = hn::LoadU(d, x[i] + row + v * vector_lanes);
        for (std::size_t j = 0; j < n_b_here; ++j) sum[i][j][v] = fused_mul_add(of_a, of_b[j], sum[i][j][v]);
      }
    }
  };
  double const *x[n_a_here], *y[n_b_here];
  for (std::size_t i = 0; i < n_a_here; ++i) x[i] = a + i * a_stride;
  for (std::size_t j = 0; j < n_b_here; ++j) y[j] = b + j * b_stride;
  std::size_t row = 0;
  for (; row + n_lanes <= n; row += n_lanes) add(x, y, row);
  if (row < n) {
    double last_x[n_a_here][n_lanes] = {}, last_y[n_b_here][n_lanes] = {};
    for (std::size_t i = 0; i < n_a_here; ++i) x[i] = std::copy_n(x[i] + row, n - row, last_x[i]) - (n - row);
    for (std::size_t j = 0; j < n_b_here; ++j) y[j] = std::copy_n(y[j] + row, n - row, last_y[j]) - (n - row);
    add(x, y, 0);
  }

  for (std::size_t i = 0; i < n_a_here; ++i)
    for (std::size_t j = 0; j < n_b_here; ++j) {
      double lanes[n_lanes];
      for (std::size_t v = 0; v < n_vectors; ++v) hn::StoreU(sum[i][j][v], d, lanes + v * vector_lanes);
      out[i + j * n_a] = sum_lanes(lanes);
    }
}

}  // namespace

void products(Columns a, Columns b, std::size_t n, double* out) {
  // all of `a` against a few columns of `b`: they stay in the L1 cache, `a` in the L2 cache
  auto const add = [&]<std::size_t n_a_here, std::size_t n_b_here>(std::size_t i, std::size_t j) {
    add_products<n_a_here, n_b_here>(a.first + i * a.stride, a.stride, b.first + j * b.stride, b.stride, n,
                                     out + i + j * a.count, a.count);
  };
  std::size_t j = 0;
  for (; j + tile <= b.count; j += tile) {
    std::size_t i = 0;
    for (; i + tile <= a.count; i += tile) add.template operator()<tile, tile>(i, j);
    for (; i < a.count; ++i) add.template operator()<1, tile>(i, j);
  }
  for (; j < b.count; ++j) {
    std::size_t i = 0;
    for (; i + tile <= a.count; i += tile) add.template operator()<tile, 1>(i, j);
    for (; i < a.count; ++i) add.template operator()<1, 1>(i, j);
  }
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {
TORQUESCOPE_EXPORT(products);
}  // namespace

void column_products(Columns a, Columns b, std::size_t n, double* out) { TORQUESCOPE_DISPATCH(products)(a, b, n, out); }

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
