#include "kernels/gram.hpp"

#include <algorithm>

#include "kernels/dispatch-inl.hpp"
#include "kernels/lane_sum.hpp"
#include "kernels/pairwise_tree.hpp"
#include "kernels/sample_tiles.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/gram.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "kernels/double_lanes-inl.hpp"

#ifndef TORQUESCOPE_KERNELS_GRAM_CHUNK
#define TORQUESCOPE_KERNELS_GRAM_CHUNK
namespace torquescope::kernels {
// tiles that are packed, transformed and multiplied while they are in L1
inline constexpr std::size_t chunk_tiles = 8;
inline constexpr std::size_t chunk_samples = chunk_tiles * tile_samples;
}  // namespace torquescope::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {

// rows of a square of products held in registers: 16 of 32, or 8 of 16
inline constexpr std::size_t square = vector_lanes == n_lanes ? 4 : 2;

// adds y_i y_j of a chunk to the lanes of one square of pairs; places beyond n_rows are computed and thrown away
HWY_INLINE void add_square(double const* HWY_RESTRICT chunk, std::size_t n_rows, std::size_t first_i,
                           std::size_t first_j, double* HWY_RESTRICT lanes) {
  std::size_t row_i[square], row_j[square];
  for (std::size_t k = 0; k < square; ++k) {
    row_i[k] = std::min(first_i + k, n_rows - 1) * tile_samples;
    row_j[k] = std::min(first_j + k, n_rows - 1) * tile_samples;
  }
  V sum[square][square][n_vectors];
#pragma GCC unroll 4
  for (std::size_t i = 0; i < square; ++i)
#pragma GCC unroll 4
    for (std::size_t j = 0; j < square; ++j)
#pragma GCC unroll 4
      for (std::size_t v = 0; v < n_vectors; ++v)
        sum[i][j][v] = hn::LoadU(d, lanes + (i * square + j) * n_lanes + v * vector_lanes);

  for (std::size_t tile = 0; tile < chunk_tiles; ++tile, chunk += n_rows * tile_samples) {
    for (std::size_t sample = 0; sample < tile_samples; sample += n_lanes) {
#pragma GCC unroll 4
      for (std::size_t v = 0; v < n_vectors; ++v) {
        double const* const from = chunk + sample + v * vector_lanes;
        V right[square];
#pragma GCC unroll 4
        for (std::size_t j = 0; j < square; ++j) right[j] = hn::LoadU(d, from + row_j[j]);
#pragma GCC unroll 4
        for (std::size_t i = 0; i < square; ++i) {
          V const left = hn::LoadU(d, from + row_i[i]);
#pragma GCC unroll 4
          for (std::size_t j = 0; j < square; ++j) sum[i][j][v] = fused_mul_add(left, right[j], sum[i][j][v]);
        }
      }
    }
  }

#pragma GCC unroll 4
  for (std::size_t i = 0; i < square; ++i)
#pragma GCC unroll 4
    for (std::size_t j = 0; j < square; ++j)
#pragma GCC unroll 4
      for (std::size_t v = 0; v < n_vectors; ++v)
        hn::StoreU(sum[i][j][v], d, lanes + (i * square + j) * n_lanes + v * vector_lanes);
}

std::size_t square_rows() { return square; }

// lanes: [square of pairs with i <= j, row by row][square][square][n_lanes]
void add_chunk(double const* chunk, std::size_t n_rows, double* lanes) {
  for (std::size_t i = 0; i < n_rows; i += square)
    for (std::size_t j = i; j < n_rows; j += square, lanes += square * square * n_lanes)
      add_square(chunk, n_rows, i, j, lanes);
}

// vectors that are whitened together: each is one long chain of multiply-adds
inline constexpr std::size_t n_together = 4;
static_assert(tile_samples % (n_together * vector_lanes) == 0);

struct Together {
  V part[n_together];

  HWY_INLINE explicit Together(double const* from) {
#pragma GCC unroll 4
    for (std::size_t v = 0; v < n_together; ++v) part[v] = hn::LoadU(d, from + v * vector_lanes);
  }
  HWY_INLINE void subtract(double const* from, double factor) {
#pragma GCC unroll 4
    for (std::size_t v = 0; v < n_together; ++v)
      part[v] = fused_neg_mul_add(hn::LoadU(d, from + v * vector_lanes), hn::Set(d, factor), part[v]);
  }
  HWY_INLINE void store_divided(double divisor, double* to) const {
#pragma GCC unroll 4
    for (std::size_t v = 0; v < n_together; ++v)
      hn::StoreU(hn::Div(part[v], hn::Set(d, divisor)), d, to + v * vector_lanes);
  }
};

// turns phi, tau of a chunk into phi root^-1, tau - phi centre, in place
void whiten_chunk(double* chunk, std::size_t n_regressors, double const* root, double const* centre) {
  for (std::size_t tile = 0; tile < chunk_tiles; ++tile, chunk += (n_regressors + 1) * tile_samples) {
    for (std::size_t sample = 0; sample < tile_samples; sample += n_together * vector_lanes) {
      double* const column = chunk + sample;
      double* const tau = column + n_regressors * tile_samples;
      // the residual first: it needs phi as it was
      Together residual(tau);
      for (std::size_t r = 0; r < n_regressors; ++r) residual.subtract(column + r * tile_samples, centre[r]);
      residual.store_divided(1.0, tau);

      for (std::size_t r = 0; r < n_regressors; ++r) {
        Together q(column + r * tile_samples);
        for (std::size_t s = 0; s < r; ++s) q.subtract(column + s * tile_samples, root[s * n_regressors + r]);
        q.store_divided(root[r * n_regressors + r], column + r * tile_samples);
      }
    }
  }
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(square_rows);
TORQUESCOPE_EXPORT(add_chunk);
TORQUESCOPE_EXPORT(whiten_chunk);

constexpr std::size_t largest_square = 4;

std::size_t pair_count(std::size_t n_regressors) { return (n_regressors + 1) * (n_regressors + 2) / 2; }

// whichever instruction set: the largest square wastes most
std::size_t lanes_size(std::size_t n_regressors) {
  std::size_t const squares = (n_regressors + largest_square) / largest_square;
  return squares * (squares + 1) / 2 * largest_square * largest_square * n_lanes;
}

// samples first .. first + count of the columns as tiles; the rest of the chunk becomes zero
void pack_chunk(SampleColumns const& samples, std::size_t first, double* chunk) {
  std::size_t const count = std::min(chunk_samples, samples.n_samples - first);
  std::size_t const packed = packed_size(count, samples.n_regressors);
  pack_tiles(samples.phi + first, samples.leading_dimension, samples.tau + first, count, samples.n_regressors, chunk);
  std::fill(chunk + packed, chunk + packed_size(chunk_samples, samples.n_regressors), 0.0);
}

// upper triangle, row by row
void sum_pairs(double const* lanes, std::size_t n_rows, std::size_t square, double* pairs) {
  for (std::size_t i = 0; i < n_rows; ++i) {
    for (std::size_t j = i; j < n_rows; ++j) {
      std::size_t const squares = (n_rows + square - 1) / square, a = i / square, b = j / square;
      // squares of the rows before a, then along row a
      std::size_t const before = a * squares - a * (a + 1) / 2 + b;
      std::size_t const place = (before * square + i % square) * square + j % square;
      *pairs++ = sum_lanes(lanes + place * n_lanes);
    }
  }
}

template <class Transform>
void sum_products(SampleColumns const& samples, double* sums, double* workspace, Transform const& transform) {
  std::size_t const n_rows = samples.n_regressors + 1, n_pairs = pair_count(samples.n_regressors);
  double* const chunk = workspace;
  double* const lanes = chunk + packed_size(chunk_samples, samples.n_regressors);
  double* const pairs = lanes + lanes_size(samples.n_regressors);
  PairwiseTree tree(n_pairs, pairs + n_pairs);
  auto const add = TORQUESCOPE_DISPATCH(add_chunk);
  std::size_t const square = TORQUESCOPE_DISPATCH(square_rows)();

  for (std::size_t block = 0; block < samples.n_samples; block += block_samples) {
    std::fill_n(lanes, lanes_size(samples.n_regressors), 0.0);
    std::size_t const end = std::min(block + block_samples, samples.n_samples);
    for (std::size_t first = block; first < end; first += chunk_samples) {
      pack_chunk(samples, first, chunk);
      transform(chunk);
      add(chunk, n_rows, lanes);
    }
    sum_pairs(lanes, n_rows, square, pairs);
    tree.add(pairs);
  }
  tree.total(pairs);

  double const* pair = pairs;
  for (std::size_t i = 0; i < n_rows; ++i)
    for (std::size_t j = i; j < n_rows; ++j) sums[i * n_rows + j] = sums[j * n_rows + i] = *pair++;
}

}  // namespace

std::size_t gram_workspace_size(std::size_t n_samples, std::size_t n_regressors) {
  std::size_t const n_blocks = (n_samples + block_samples - 1) / block_samples, n_pairs = pair_count(n_regressors);
  return packed_size(chunk_samples, n_regressors) + lanes_size(n_regressors) + n_pairs +
         PairwiseTree::workspace_size(n_blocks, n_pairs);
}

void gram(SampleColumns const& samples, double* sums, double* workspace) {
  sum_products(samples, sums, workspace, [](double*) {});
}

void whitened_gram(SampleColumns const& samples, double const* root, double const* centre, double* sums,
                   double* workspace) {
  auto const whiten = TORQUESCOPE_DISPATCH(whiten_chunk);
  sum_products(samples, sums, workspace, [&](double* chunk) { whiten(chunk, samples.n_regressors, root, centre); });
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
