// The energy of a single joint sorted by direction: R = 4, of which two columns are constant over a run.
//
// Counts     R + 1 multiply-adds as residual_energy counts them, so that percent_of_peak compares speed: above 100 is
//            possible

#include "kernels/levelled_energy.hpp"

#include <string>
#include <vector>

#include "bench/kernels/kernel_benchmarks.hpp"
#include "bench/kernels/percent_of_peak.hpp"
#include "bench/kernels/random_tiles.hpp"
#include "kernels/aligned_doubles.hpp"
#include "kernels/dispatch.hpp"

namespace torquescope::bench {
namespace {

void run(benchmark::State& state, std::string const& instruction_set, std::size_t n_samples) {
  constexpr std::size_t n_members = 30;
  kernels::force_instruction_set(instruction_set);
  std::size_t const n_tiles = n_samples / kernels::tile_samples;
  std::size_t const run_end[] = {n_tiles / 2, n_tiles}, constant[] = {2, 3}, varying[] = {0, 1};
  double const level[] = {1, 0, 0, 1};
  kernels::LevelledTiles tiles;
  tiles.varying = random_tiles(n_tiles * kernels::tile_samples, 2);
  tiles.rest = {nullptr, 0, 4};
  tiles.n_runs = 2;
  tiles.run_end = run_end;
  tiles.level = level;
  tiles.n_constant = 2;
  tiles.constant_column = constant;
  tiles.varying_column = varying;

  std::vector<double> const members(n_members * 4, 0.5);
  std::vector<double> energy(n_members);
  kernels::AlignedDoubles workspace(kernels::levelled_workspace_size(tiles, n_members));
  double const fma = static_cast<double>(tiles.varying.n_samples * n_members * 5);
  measure(state, {tiles.varying.n_samples, n_members, fma}, [&] {
    kernels::levelled_residual_energy(tiles, {members.data(), n_members, 4}, energy.data(), workspace.data());
  });
  kernels::release_instruction_set();
}

}  // namespace

void add_levelled_energy_benchmarks(std::vector<std::string> const& instruction_sets) {
  for (std::size_t n_samples : {10'000, 1'000'000, 10'000'000})
    for (auto const& name : instruction_sets)
      add_benchmark(case_name("levelled_energy", name, 4, n_samples, 30), turns_for(n_samples),
                    [name, n_samples](benchmark::State& state) { run(state, name, n_samples); });
}

}  // namespace torquescope::bench
