#include "kernels/levelled_energy.hpp"

#include <algorithm>
#include <cassert>

#include "kernels/dispatch-inl.hpp"
#include "kernels/lane_sum.hpp"
#include "kernels/packed_parameters.hpp"
#include "kernels/pairwise_tree.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/levelled_energy.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "kernels/energy_tile-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {

void sum_levelled_squares(SampleTiles const& tiles, std::size_t first_tile, std::size_t last_tile, std::size_t n_groups,
                          double const* parameters, double const* constant, double* lanes) {
  sum_block(tiles, first_tile, last_tile, n_groups, parameters, FromTorqueLess{constant}, Square{}, lanes);
}

void sum_levelled_huber(SampleTiles const& tiles, std::size_t first_tile, std::size_t last_tile, std::size_t n_groups,
                        double const* parameters, double const* constant, double delta, double* lanes) {
  sum_block(tiles, first_tile, last_tile, n_groups, parameters, FromTorqueLess{constant}, Huber{hn::Set(d, delta)},
            lanes);
}

// constant[m] = sum_k level[k] parameters[group][k][m]; once per run, one lane at a time
void sum_constants(double const* level, std::size_t n_constant, std::size_t n_groups, double const* parameters,
                   double* constant) {
  hn::CappedTag<double, 1> const one;
  for (std::size_t group = 0; group < n_groups; ++group) {
    for (std::size_t m = 0; m < group_members; ++m) {
      auto sum = hn::Zero(one);
      for (std::size_t k = 0; k < n_constant; ++k)
        sum = fused_mul_add(hn::Set(one, level[k]),
                            hn::Set(one, parameters[(group * n_constant + k) * group_members + m]), sum);
      constant[group * group_members + m] = hn::GetLane(sum);
    }
  }
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(sum_levelled_squares);
TORQUESCOPE_EXPORT(sum_levelled_huber);
TORQUESCOPE_EXPORT(sum_constants);

constexpr std::size_t block_tiles = block_samples / tile_samples;

std::size_t block_count(LevelledTiles const& tiles) {
  std::size_t count = 0, begin = 0;
  for (std::size_t run = 0; run < tiles.n_runs; begin = tiles.run_end[run++])
    count += (tiles.run_end[run] - begin + block_tiles - 1) / block_tiles;
  return count;
}

std::size_t rest_workspace_size(LevelledTiles const& tiles, std::size_t n_members) {
  return energy_workspace_size(tiles.rest.n_samples, tiles.rest.n_regressors, n_members);
}

// sum_rest(energy, workspace); sum_block(first_tile, last_tile, n_groups, varying, constant, lanes)
template <class SumRest, class SumBlock>
void sum_runs(LevelledTiles const& tiles, Candidates const& candidates, double* energy, double* workspace,
              SumRest const& sum_rest, SumBlock const& sum_block) {
  assert(tiles.varying.n_samples % tile_samples == 0);
  std::size_t const n_members = candidates.n_members, n_groups = group_count(n_members);
  std::size_t const n_varying = tiles.varying.n_regressors;
  double* const lanes = workspace;  // first: on cache lines when the workspace is
  double* const varying = lanes + n_groups * group_members * n_lanes;
  double* const levelled = varying + packed_parameters_size(n_members, n_varying);
  double* const constant = levelled + packed_parameters_size(n_members, tiles.n_constant);
  double* const rest = constant + n_groups * group_members;
  PairwiseTree tree(n_members, rest + rest_workspace_size(tiles, n_members));

  sum_rest(energy, rest);
  tree.add(energy);
  pack_parameters(candidates, tiles.varying_column, n_varying, varying);
  pack_parameters(candidates, tiles.constant_column, tiles.n_constant, levelled);
  auto const add_up = TORQUESCOPE_DISPATCH(sum_constants);
  std::size_t begin = 0;
  for (std::size_t run = 0; run < tiles.n_runs; begin = tiles.run_end[run++]) {
    add_up(tiles.level + run * tiles.n_constant, tiles.n_constant, n_groups, levelled, constant);
    for (std::size_t first = begin; first < tiles.run_end[run]; first += block_tiles) {
      std::size_t const last = std::min(first + block_tiles, tiles.run_end[run]);
      sum_block(first, last, n_groups, varying, constant, lanes);
      for (std::size_t m = 0; m < n_members; ++m) energy[m] = sum_lanes(lanes + m * n_lanes);
      tree.add(energy);
    }
  }
  tree.total(energy);
}

}  // namespace

std::size_t levelled_workspace_size(LevelledTiles const& tiles, std::size_t n_members) {
  std::size_t const n_places = group_count(n_members) * group_members;
  return n_places * (tiles.varying.n_regressors + tiles.n_constant + 1 + n_lanes) +
         rest_workspace_size(tiles, n_members) + PairwiseTree::workspace_size(block_count(tiles) + 1, n_members);
}

void levelled_residual_energy(LevelledTiles const& tiles, Candidates const& candidates, double* energy,
                              double* workspace) {
  auto const kernel = TORQUESCOPE_DISPATCH(sum_levelled_squares);
  sum_runs(
      tiles, candidates, energy, workspace,
      [&](double* sum, double* rest) { residual_energy(tiles.rest, candidates, sum, rest); },
      [&](std::size_t first, std::size_t last, std::size_t n_groups, double const* varying, double const* constant,
          double* lanes) { kernel(tiles.varying, first, last, n_groups, varying, constant, lanes); });
}

void levelled_huber_energy(LevelledTiles const& tiles, Candidates const& candidates, double delta, double* energy,
                           double* workspace) {
  assert(delta > 0);
  auto const kernel = TORQUESCOPE_DISPATCH(sum_levelled_huber);
  sum_runs(
      tiles, candidates, energy, workspace,
      [&](double* sum, double* rest) { huber_energy(tiles.rest, candidates, delta, sum, rest); },
      [&](std::size_t first, std::size_t last, std::size_t n_groups, double const* varying, double const* constant,
          double* lanes) { kernel(tiles.varying, first, last, n_groups, varying, constant, delta, lanes); });
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
