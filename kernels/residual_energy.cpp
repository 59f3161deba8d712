#include "kernels/residual_energy.hpp"

#include <algorithm>
#include <cassert>

#include "kernels/dispatch-inl.hpp"
#include "kernels/lane_sum.hpp"
#include "kernels/packed_parameters.hpp"
#include "kernels/pairwise_tree.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/residual_energy.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "kernels/energy_tile-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {

void sum_block_squares(SampleTiles const& tiles, std::size_t first_tile, std::size_t last_tile, std::size_t n_groups,
                       double const* parameters, double* lanes) {
  sum_block(tiles, first_tile, last_tile, n_groups, parameters, FromTorque{}, Square{}, lanes);
}

void sum_block_huber(SampleTiles const& tiles, std::size_t first_tile, std::size_t last_tile, std::size_t n_groups,
                     double const* parameters, double delta, double* lanes) {
  sum_block(tiles, first_tile, last_tile, n_groups, parameters, FromTorque{}, Huber{hn::Set(d, delta)}, lanes);
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(sum_block_squares);
TORQUESCOPE_EXPORT(sum_block_huber);

std::size_t block_count(std::size_t n_samples) { return (n_samples + block_samples - 1) / block_samples; }

// sum_block(first_tile, last_tile, n_groups, packed parameters, lanes) for one block after the other
template <class SumBlock>
void sum_blocks(SampleTiles const& tiles, Candidates const& candidates, double* energy, double* workspace,
                SumBlock const& sum_block) {
  assert(candidates.n_members == 0 || candidates.leading_dimension >= tiles.n_regressors);
  std::size_t const n_members = candidates.n_members;
  std::size_t const n_groups = group_count(n_members);
  double* const lanes = workspace;  // first: on cache lines when the workspace is
  double* const packed = lanes + n_groups * group_members * n_lanes;
  PairwiseTree tree(n_members, packed + packed_parameters_size(n_members, tiles.n_regressors));

  pack_parameters(candidates, nullptr, tiles.n_regressors, packed);
  constexpr std::size_t block_tiles = block_samples / tile_samples;
  std::size_t const n_tiles = tile_count<double>(tiles.n_samples);
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
  auto const kernel = TORQUESCOPE_DISPATCH(sum_block_squares);
  sum_blocks(tiles, candidates, energy, workspace,
             [&](std::size_t first, std::size_t last, std::size_t n_groups, double const* packed, double* lanes) {
               kernel(tiles, first, last, n_groups, packed, lanes);
             });
}

void huber_energy(SampleTiles const& tiles, Candidates const& candidates, double delta, double* energy,
                  double* workspace) {
  assert(delta > 0);
  auto const kernel = TORQUESCOPE_DISPATCH(sum_block_huber);
  sum_blocks(tiles, candidates, energy, workspace,
             [&](std::size_t first, std::size_t last, std::size_t n_groups, double const* packed, double* lanes) {
               kernel(tiles, first, last, n_groups, packed, delta, lanes);
             });
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
