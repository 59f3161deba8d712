#include "kernels/residual_energy.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "kernels/pairwise_tree.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/residual_energy.cpp"
#include "hwy/cache_control.h"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "kernels/fused-inl.hpp"

#ifndef TORQUESCOPE_KERNELS_LANES
#define TORQUESCOPE_KERNELS_LANES
namespace torquescope::kernels {
// logical lanes: the same on every instruction set, whatever its vectors hold
inline constexpr std::size_t n_lanes = 8;
}  // namespace torquescope::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {

using D = hn::CappedTag<double, n_lanes>;
using Vector = hn::Vec<D>;
inline constexpr D d;
inline constexpr std::size_t vector_lanes = hn::MaxLanes(d);
// 4 x 6 accumulators fill 32 registers; AVX2 has 16 and gets 2 x 6; narrower vectors cover the 8 lanes once
inline constexpr std::size_t n_vectors = vector_lanes == n_lanes ? 4 : n_lanes / vector_lanes;
inline constexpr std::size_t pass_samples = n_vectors * vector_lanes;
static_assert(pass_samples % n_lanes == 0 && tile_samples % pass_samples == 0);

struct Square {
  HWY_INLINE Vector add(Vector residual, Vector sum) const { return fused_mul_add(residual, residual, sum); }
};

struct Huber {
  Vector delta;
  // rho = c (2 |e| - c) with c = min(|e|, delta): no branch, and exactly e^2 inside
  HWY_INLINE Vector add(Vector residual, Vector sum) const {
    Vector const size = hn::Abs(residual);
    Vector const capped = hn::Min(size, delta);
    return fused_mul_add(capped, hn::Add(size, hn::Sub(size, capped)), sum);
  }
};

// Asks for a later tile while this one is computed, a little in each step of the inner loop. Addresses, not pointers:
// they may run past the end, where a prefetch does nothing.
//
// Measured on a shared AMD Zen 4 (bench_residual_energy, medians, AVX2, n = 1e6, 30 members, R = 4 11 24 60; % of FMA
// peak): one prefetch per step, evenly spread, 84 90 92 93; all of them during the first group 84 70 59 56, since a
// burst fills the queue of outstanding lines and stops the arithmetic. On AVX-512 with fewer than 5 groups a step is
// longer than a cache line and one prefetch leaves lines out. Two per step or a loop over the lines repair that about
// equally (single runs, differences near the noise); two cost AVX2 less. Unrolling the inner loop by 2 gained only at R
// = 11 on AVX2.
struct TileStream {
  std::uintptr_t address;
  std::uintptr_t step;  // bytes

  HWY_INLINE void next() {
    hwy::Prefetch(reinterpret_cast<double const*>(address));
    hwy::Prefetch(reinterpret_cast<double const*>(address + step / 2));
    address += step;
  }
};

// adds the losses of one tile to the lanes of one group; parameters[r][group_members], lanes[group_members][n_lanes]
template <class Loss>
HWY_INLINE void add_tile(double const* HWY_RESTRICT tile, std::size_t n_regressors,
                         double const* HWY_RESTRICT parameters, Loss const& loss, TileStream& ahead,
                         double* HWY_RESTRICT lanes) {
  for (std::size_t pass = 0; pass < tile_samples; pass += pass_samples) {
    Vector residual[n_vectors][group_members];
    double const* row = tile + n_regressors * tile_samples + pass;
#pragma GCC unroll 8
    for (std::size_t v = 0; v < n_vectors; ++v) {
      Vector const tau = hn::LoadU(d, row + v * vector_lanes);
#pragma GCC unroll 6
      for (std::size_t m = 0; m < group_members; ++m) residual[v][m] = tau;
    }

    row = tile + pass;
    for (std::size_t r = 0; r < n_regressors; ++r, row += tile_samples) {
      ahead.next();
      Vector phi[n_vectors];
#pragma GCC unroll 8
      for (std::size_t v = 0; v < n_vectors; ++v) phi[v] = hn::LoadU(d, row + v * vector_lanes);
#pragma GCC unroll 6
      for (std::size_t m = 0; m < group_members; ++m) {
        Vector const parameter = hn::Set(d, parameters[r * group_members + m]);
#pragma GCC unroll 8
        for (std::size_t v = 0; v < n_vectors; ++v)
          residual[v][m] = fused_neg_mul_add(phi[v], parameter, residual[v][m]);
      }
    }

#pragma GCC unroll 6
    for (std::size_t m = 0; m < group_members; ++m) {
#pragma GCC unroll 8
      for (std::size_t lane = 0; lane < n_lanes; lane += vector_lanes) {
        Vector sum = hn::LoadU(d, lanes + m * n_lanes + lane);
#pragma GCC unroll 8
        for (std::size_t v = lane / vector_lanes; v < n_vectors; v += n_lanes / vector_lanes)
          sum = loss.add(residual[v][m], sum);
        hn::StoreU(sum, d, lanes + m * n_lanes + lane);
      }
    }
  }
}

// far enough to hide the latency of memory, near enough to be still in L1 when it is read
inline constexpr std::size_t prefetch_bytes = 16384;

// `tile` in as many steps as add_tile takes for all groups
HWY_INLINE TileStream stream_of(double const* tile, std::size_t n_regressors, std::size_t n_groups) {
  std::size_t const tile_bytes = (n_regressors + 1) * tile_samples * sizeof(double);
  std::size_t const n_steps = std::max<std::size_t>(n_groups * (tile_samples / pass_samples) * n_regressors, 1);
  return {reinterpret_cast<std::uintptr_t>(tile), (tile_bytes + n_steps - 1) / n_steps};
}

// lanes of one block of samples, [member][n_lanes]
template <class Loss>
HWY_INLINE void sum_block(SampleTiles const& tiles, std::size_t first_tile, std::size_t last_tile, std::size_t n_groups,
                          double const* parameters, Loss const& loss, double* lanes) {
  std::size_t const n_tiles = (tiles.n_samples + tile_samples - 1) / tile_samples;
  std::size_t const tile_size = (tiles.n_regressors + 1) * tile_samples;
  std::size_t const distance = (prefetch_bytes + tile_size * sizeof(double) - 1) / (tile_size * sizeof(double));
  std::fill_n(lanes, n_groups * group_members * n_lanes, 0.0);
  for (std::size_t t = first_tile; t < last_tile; ++t) {
    double const* const tile = tiles.data + t * tile_size;
    double const* const later = t + distance < n_tiles ? tile + distance * tile_size : tile;
    TileStream ahead = stream_of(later, tiles.n_regressors, n_groups);
    for (std::size_t group = 0; group < n_groups; ++group)
      add_tile(tile, tiles.n_regressors, parameters + group * group_members * tiles.n_regressors, loss, ahead,
               lanes + group * group_members * n_lanes);
  }
}

void sum_block_squares(SampleTiles const& tiles, std::size_t first_tile, std::size_t last_tile, std::size_t n_groups,
                       double const* parameters, double* lanes) {
  sum_block(tiles, first_tile, last_tile, n_groups, parameters, Square{}, lanes);
}

void sum_block_huber(SampleTiles const& tiles, std::size_t first_tile, std::size_t last_tile, std::size_t n_groups,
                     double const* parameters, double delta, double* lanes) {
  sum_block(tiles, first_tile, last_tile, n_groups, parameters, Huber{hn::Set(d, delta)}, lanes);
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

HWY_EXPORT(sum_block_squares);
HWY_EXPORT(sum_block_huber);

std::size_t group_count(std::size_t n_members) { return (n_members + group_members - 1) / group_members; }
std::size_t block_count(std::size_t n_samples) { return (n_samples + block_samples - 1) / block_samples; }

// [group][r][group_members]; places behind the last member are zero
void pack_parameters(Candidates const& candidates, std::size_t n_regressors, double* packed) {
  for (std::size_t first = 0; first < candidates.n_members; first += group_members) {
    for (std::size_t r = 0; r < n_regressors; ++r) {
      for (std::size_t m = first; m < first + group_members; ++m)
        *packed++ = m < candidates.n_members ? candidates.data[m * candidates.leading_dimension + r] : 0.0;
    }
  }
}

double sum_lanes(double const* lane) {
  return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

// sum_block(first_tile, last_tile, n_groups, packed parameters, lanes) for one block after the other
template <class SumBlock>
void sum_blocks(SampleTiles const& tiles, Candidates const& candidates, double* energy, double* workspace,
                SumBlock const& sum_block) {
  assert(candidates.n_members == 0 || candidates.leading_dimension >= tiles.n_regressors);
  std::size_t const n_members = candidates.n_members;
  std::size_t const n_groups = group_count(n_members);
  double* const packed = workspace;
  double* const lanes = packed + packed_parameters_size(n_members, tiles.n_regressors);
  PairwiseTree tree(n_members, lanes + n_groups * group_members * n_lanes);

  pack_parameters(candidates, tiles.n_regressors, packed);
  constexpr std::size_t block_tiles = block_samples / tile_samples;
  std::size_t const n_tiles = (tiles.n_samples + tile_samples - 1) / tile_samples;
  for (std::size_t first = 0; first < n_tiles; first += block_tiles) {
    sum_block(first, std::min(first + block_tiles, n_tiles), n_groups, packed, lanes);
    for (std::size_t m = 0; m < n_members; ++m) energy[m] = sum_lanes(lanes + m * n_lanes);
    tree.add(energy);
  }
  tree.total(energy);
}

}  // namespace

std::size_t packed_parameters_size(std::size_t n_members, std::size_t n_regressors) {
  return group_count(n_members) * group_members * n_regressors;
}

std::size_t energy_workspace_size(std::size_t n_samples, std::size_t n_regressors, std::size_t n_members) {
  return packed_parameters_size(n_members, n_regressors) + group_count(n_members) * group_members * n_lanes +
         PairwiseTree::workspace_size(block_count(n_samples), n_members);
}

void residual_energy(SampleTiles const& tiles, Candidates const& candidates, double* energy, double* workspace) {
  auto const kernel = HWY_DYNAMIC_DISPATCH(sum_block_squares);
  sum_blocks(tiles, candidates, energy, workspace,
             [&](std::size_t first, std::size_t last, std::size_t n_groups, double const* packed, double* lanes) {
               kernel(tiles, first, last, n_groups, packed, lanes);
             });
}

void huber_energy(SampleTiles const& tiles, Candidates const& candidates, double delta, double* energy,
                  double* workspace) {
  assert(delta > 0);
  auto const kernel = HWY_DYNAMIC_DISPATCH(sum_block_huber);
  sum_blocks(tiles, candidates, energy, workspace,
             [&](std::size_t first, std::size_t last, std::size_t n_groups, double const* packed, double* lanes) {
               kernel(tiles, first, last, n_groups, packed, delta, lanes);
             });
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
