#include "kernels/float_energy.hpp"

#include <algorithm>
#include <cassert>

#include "kernels/dispatch-inl.hpp"
#include "kernels/lane_sum.hpp"
#include "kernels/packed_parameters.hpp"
#include "kernels/pairwise_tree.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/float_energy.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "kernels/energy_tile-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {

inline constexpr hn::CappedTag<float, float_lanes> df;
using FloatVector = hn::Vec<hn::CappedTag<float, float_lanes>>;
inline constexpr std::size_t floats = hn::MaxLanes(df);
// 4 x 6 accumulators as energy_tile-inl.hpp has them, with twice the samples in each
inline constexpr std::size_t float_vectors = floats == float_lanes ? 4 : float_lanes / floats;
inline constexpr std::size_t float_pass = float_vectors * floats;
static_assert(float_pass % float_lanes == 0 && float_tile_samples % float_pass == 0);

// adds the squares of one pass over a tile to the lanes of one group
HWY_INLINE void add_squares(float const* HWY_RESTRICT tile, std::size_t n_regressors,
                            float const* HWY_RESTRICT parameters, TileStream& ahead, float* HWY_RESTRICT lanes) {
  FloatVector residual[float_vectors][group_members];
  float const* row = tile + n_regressors * float_tile_samples;
#pragma GCC unroll 16
  for (std::size_t v = 0; v < float_vectors; ++v) {
#pragma GCC unroll 6
    for (std::size_t m = 0; m < group_members; ++m) residual[v][m] = hn::LoadU(df, row + v * floats);
  }
  row = tile;
  for (std::size_t r = 0; r < n_regressors; ++r, row += float_tile_samples) {
    ahead.next();
    FloatVector phi[float_vectors];
#pragma GCC unroll 16
    for (std::size_t v = 0; v < float_vectors; ++v) phi[v] = hn::LoadU(df, row + v * floats);
#pragma GCC unroll 6
    for (std::size_t m = 0; m < group_members; ++m) {
      FloatVector const parameter = hn::Set(df, parameters[r * group_members + m]);
#pragma GCC unroll 16
      for (std::size_t v = 0; v < float_vectors; ++v)
        residual[v][m] = fused_neg_mul_add(phi[v], parameter, residual[v][m]);
    }
  }
#pragma GCC unroll 6
  for (std::size_t m = 0; m < group_members; ++m) {
#pragma GCC unroll 16
    for (std::size_t lane = 0; lane < float_lanes; lane += floats) {
      FloatVector sum = hn::LoadU(df, lanes + m * float_lanes + lane);
#pragma GCC unroll 16
      for (std::size_t v = lane / floats; v < float_vectors; v += float_lanes / floats)
        sum = fused_mul_add(residual[v][m], residual[v][m], sum);
      hn::StoreU(sum, df, lanes + m * float_lanes + lane);
    }
  }
}

// lanes of one block of samples, [member][float_lanes]
void sum_block_float(FloatTiles const& tiles, std::size_t first_tile, std::size_t last_tile, std::size_t n_groups,
                     float const* parameters, float* lanes) {
  std::size_t const R = tiles.n_regressors;
  std::size_t const tile_size = (R + 1) * float_tile_samples;
  std::size_t const tile_bytes = tile_size * sizeof(float);
  std::size_t const n_tiles = (tiles.n_samples + float_tile_samples - 1) / float_tile_samples;
  std::size_t const distance = (prefetch_bytes + tile_bytes - 1) / tile_bytes;
  std::size_t const n_steps = std::max<std::size_t>(n_groups * (float_tile_samples / float_pass) * R, 1);
  std::fill_n(lanes, n_groups * group_members * float_lanes, 0.0F);
  for (std::size_t t = first_tile; t < last_tile; ++t) {
    float const* const tile = tiles.data + t * tile_size;
    float const* const later = t + distance < n_tiles ? tile + distance * tile_size : tile;
    TileStream ahead{reinterpret_cast<std::uintptr_t>(later), (tile_bytes + n_steps - 1) / n_steps};
    for (std::size_t group = 0; group < n_groups; ++group)
      for (std::size_t pass = 0; pass < float_tile_samples; pass += float_pass)
        add_squares(tile + pass, R, parameters + group * group_members * R, ahead,
                    lanes + group * group_members * float_lanes);
  }
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(sum_block_float);

std::size_t tile_count(std::size_t n_samples) { return (n_samples + float_tile_samples - 1) / float_tile_samples; }

double sum_float_lanes(float const* lane) {
  double folded[n_lanes];
  for (std::size_t l = 0; l < n_lanes; ++l)
    folded[l] = static_cast<double>(lane[l]) + static_cast<double>(lane[l + n_lanes]);
  return sum_lanes(folded);
}

}  // namespace

std::size_t float_packed_size(std::size_t n_samples, std::size_t n_regressors) {
  return tile_count(n_samples) * float_tile_samples * (n_regressors + 1);
}

FloatTiles pack_float_tiles(double const* phi, std::size_t leading_dimension, double const* tau, std::size_t n_samples,
                            std::size_t n_regressors, float* tiles) {
  assert(n_regressors == 0 || leading_dimension >= n_samples);
  float* row = tiles;
  for (std::size_t first = 0; first < n_samples; first += float_tile_samples) {
    std::size_t const count = std::min(float_tile_samples, n_samples - first);
    for (std::size_t r = 0; r <= n_regressors; ++r, row += float_tile_samples) {
      double const* const column = (r < n_regressors ? phi + r * leading_dimension : tau) + first;
      std::transform(column, column + count, row, [](double x) { return static_cast<float>(x); });
      std::fill(row + count, row + float_tile_samples, 0.0F);
    }
  }
  return {tiles, n_samples, n_regressors};
}

std::size_t float_workspace_size(std::size_t n_regressors, std::size_t n_members) {
  return group_count(n_members) * group_members * (n_regressors + float_lanes);
}

std::size_t float_sums_size(std::size_t n_samples, std::size_t n_members) {
  return PairwiseTree::workspace_size((n_samples + block_samples - 1) / block_samples, n_members);
}

void float_residual_energy(FloatTiles const& tiles, Candidates const& candidates, double* energy, float* workspace,
                           double* sums) {
  assert(candidates.n_members == 0 || candidates.leading_dimension >= tiles.n_regressors);
  std::size_t const n_groups = group_count(candidates.n_members);
  float* const lanes = workspace;  // first: on cache lines when the workspace is
  float* const packed = lanes + n_groups * group_members * float_lanes;
  PairwiseTree tree(candidates.n_members, sums);
  pack_parameters(candidates, nullptr, tiles.n_regressors, packed);

  auto const kernel = TORQUESCOPE_DISPATCH(sum_block_float);
  constexpr std::size_t block_tiles = block_samples / float_tile_samples;
  std::size_t const n_tiles = tile_count(tiles.n_samples);
  for (std::size_t first = 0; first < n_tiles; first += block_tiles) {
    kernel(tiles, first, std::min(first + block_tiles, n_tiles), n_groups, packed, lanes);
    for (std::size_t m = 0; m < candidates.n_members; ++m) energy[m] = sum_float_lanes(lanes + m * float_lanes);
    tree.add(energy);
  }
  tree.total(energy);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
