// One tile of samples against one group of candidates, the body of every energy kernel; compiled once per instruction
// set, so no #pragma once.

#include <algorithm>
#include <cstdint>

#include "hwy/cache_control.h"
#include "hwy/highway.h"
#include "kernels/lane_sum.hpp"
#include "kernels/residual_energy.hpp"
#include "kernels/sample_tiles.hpp"

#include "kernels/fused-inl.hpp"

#if defined(TORQUESCOPE_KERNELS_ENERGY_TILE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TORQUESCOPE_KERNELS_ENERGY_TILE_INL
#undef TORQUESCOPE_KERNELS_ENERGY_TILE_INL
#else
#define TORQUESCOPE_KERNELS_ENERGY_TILE_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {

template <class Number>
using TagOf = hn::CappedTag<Number, lanes_of<Number>>;
template <class Number>
using VectorOf = hn::Vec<TagOf<Number>>;
template <class Number>
inline constexpr std::size_t vector_lanes = hn::MaxLanes(TagOf<Number>{});
// 4 x 6 accumulators fill 32 registers; AVX2 has 16 and gets 2 x 6; narrower vectors cover the lanes once
template <class Number>
inline constexpr std::size_t n_vectors =
    vector_lanes<Number> == lanes_of<Number> ? 4 : lanes_of<Number> / vector_lanes<Number>;
template <class Number>
inline constexpr std::size_t pass_samples = n_vectors<Number>* vector_lanes<Number>;
static_assert(lanes_of<double> == n_lanes && pass_samples<double> % n_lanes == 0 &&
              tile_samples_of<double> % pass_samples<double> == 0);
static_assert(pass_samples<float> % lanes_of<float> == 0 && tile_samples_of<float> % pass_samples<float> == 0);

using Vector = VectorOf<double>;
inline constexpr TagOf<double> d;

struct Square {
  template <class V>
  HWY_INLINE V add(V residual, V sum) const {
    return fused_mul_add(residual, residual, sum);
  }
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
// Measured on a shared AMD Zen 4 (bench_kernels, medians, AVX2, n = 1e6, 30 members, R = 4 11 24 60; % of FMA
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

// what a residual begins with: the torque, or the torque less what is constant over the block for this member
struct FromTorque {
  HWY_INLINE FromTorque of_group(std::size_t) const { return {}; }
  template <class V>
  HWY_INLINE V first_residual(V tau, std::size_t) const {
    return tau;
  }
};
struct FromTorqueLess {
  double const* constant;  // [group][group_members]
  HWY_INLINE FromTorqueLess of_group(std::size_t group) const { return {constant + group * group_members}; }
  HWY_INLINE Vector first_residual(Vector tau, std::size_t member) const {
    return hn::Sub(tau, hn::Set(d, constant[member]));
  }
};

// adds the losses of one tile to the lanes of one group; parameters[r][group_members], lanes[group_members][lanes_of]
template <class Number, class Start, class Loss>
HWY_INLINE void add_tile(Number const* HWY_RESTRICT tile, std::size_t n_regressors,
                         Number const* HWY_RESTRICT parameters, Start const& start, Loss const& loss, TileStream& ahead,
                         Number* HWY_RESTRICT lanes) {
  constexpr TagOf<Number> tag;
  constexpr std::size_t width = vector_lanes<Number>, vectors = n_vectors<Number>, in_tile = tile_samples_of<Number>;
  for (std::size_t pass = 0; pass < in_tile; pass += pass_samples<Number>) {
    VectorOf<Number> residual[vectors][group_members];
    Number const* row = tile + n_regressors * in_tile + pass;
#pragma GCC unroll 16
    for (std::size_t v = 0; v < vectors; ++v) {
      VectorOf<Number> const tau = hn::LoadU(tag, row + v * width);
#pragma GCC unroll 6
      for (std::size_t m = 0; m < group_members; ++m) residual[v][m] = start.first_residual(tau, m);
    }

    row = tile + pass;
    for (std::size_t r = 0; r < n_regressors; ++r, row += in_tile) {
      ahead.next();
      VectorOf<Number> phi[vectors];
#pragma GCC unroll 16
      for (std::size_t v = 0; v < vectors; ++v) phi[v] = hn::LoadU(tag, row + v * width);
#pragma GCC unroll 6
      for (std::size_t m = 0; m < group_members; ++m) {
        VectorOf<Number> const parameter = hn::Set(tag, parameters[r * group_members + m]);
#pragma GCC unroll 16
        for (std::size_t v = 0; v < vectors; ++v) residual[v][m] = fused_neg_mul_add(phi[v], parameter, residual[v][m]);
      }
    }

#pragma GCC unroll 6
    for (std::size_t m = 0; m < group_members; ++m) {
#pragma GCC unroll 16
      for (std::size_t lane = 0; lane < lanes_of<Number>; lane += width) {
        VectorOf<Number> sum = hn::LoadU(tag, lanes + m * lanes_of<Number> + lane);
#pragma GCC unroll 16
        for (std::size_t v = lane / width; v < vectors; v += lanes_of<Number> / width)
          sum = loss.add(residual[v][m], sum);
        hn::StoreU(sum, tag, lanes + m * lanes_of<Number> + lane);
      }
    }
  }
}

// far enough to hide the latency of memory, near enough to be still in L1 when it is read
inline constexpr std::size_t prefetch_bytes = 16384;

// `tile` in as many steps as add_tile takes for all groups
template <class Number>
HWY_INLINE TileStream stream_of(Number const* tile, std::size_t n_regressors, std::size_t n_groups) {
  std::size_t const tile_bytes = (n_regressors + 1) * tile_samples_of<Number> * sizeof(Number);
  constexpr std::size_t passes = tile_samples_of<Number> / pass_samples<Number>;
  std::size_t const n_steps = std::max<std::size_t>(n_groups * passes * n_regressors, 1);
  return {reinterpret_cast<std::uintptr_t>(tile), (tile_bytes + n_steps - 1) / n_steps};
}

// lanes of one block of samples, [member][lanes_of]
template <class Number, class Start, class Loss>
HWY_INLINE void sum_block(Tiles<Number> const& tiles, std::size_t first_tile, std::size_t last_tile,
                          std::size_t n_groups, Number const* parameters, Start const& start, Loss const& loss,
                          Number* lanes) {
  std::size_t const n_tiles = tile_count<Number>(tiles.n_samples);
  std::size_t const tile_size = (tiles.n_regressors + 1) * tile_samples_of<Number>;
  std::size_t const distance = (prefetch_bytes + tile_size * sizeof(Number) - 1) / (tile_size * sizeof(Number));
  std::fill_n(lanes, n_groups * group_members * lanes_of<Number>, Number{0});
  for (std::size_t t = first_tile; t < last_tile; ++t) {
    Number const* const tile = tiles.data + t * tile_size;
    Number const* const later = t + distance < n_tiles ? tile + distance * tile_size : tile;
    TileStream ahead = stream_of(later, tiles.n_regressors, n_groups);
    for (std::size_t group = 0; group < n_groups; ++group)
      add_tile(tile, tiles.n_regressors, parameters + group * group_members * tiles.n_regressors, start.of_group(group),
               loss, ahead, lanes + group * group_members * lanes_of<Number>);
  }
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
