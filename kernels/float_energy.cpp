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

void sum_block_float(FloatTiles const& tiles, std::size_t first_tile, std::size_t last_tile, std::size_t n_groups,
                     float const* parameters, float* lanes) {
  sum_block(tiles, first_tile, last_tile, n_groups, parameters, FromTorque{}, Square{}, lanes);
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(sum_block_float);

constexpr std::size_t float_lanes = lanes_of<float>;

double sum_float_lanes(float const* lane) {
  double folded[n_lanes];
  for (std::size_t l = 0; l < n_lanes; ++l)
    folded[l] = static_cast<double>(lane[l]) + static_cast<double>(lane[l + n_lanes]);
  return sum_lanes(folded);
}

}  // namespace

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
  constexpr std::size_t block_tiles = block_samples / tile_samples_of<float>;
  std::size_t const n_tiles = tile_count<float>(tiles.n_samples);
  for (std::size_t first = 0; first < n_tiles; first += block_tiles) {
    kernel(tiles, first, std::min(first + block_tiles, n_tiles), n_groups, packed, lanes);
    for (std::size_t m = 0; m < candidates.n_members; ++m) energy[m] = sum_float_lanes(lanes + m * float_lanes);
    tree.add(energy);
  }
  tree.total(energy);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
