// The energy kernels against the FMA peak of the same thread, in turns.
//
// Counts     R + 1 useful multiply-adds per sample and candidate (dot product, square); padding is not counted
// Use        scripts/bench, or bench_kernels --benchmark_filter=AVX2/R:4/

#include "kernels/residual_energy.hpp"

#include <string>
#include <vector>

#include "bench/kernels/kernel_benchmarks.hpp"
#include "bench/kernels/percent_of_peak.hpp"
#include "bench/kernels/random_tiles.hpp"
#include "bench/kernels/read_rate.hpp"
#include "kernels/aligned_doubles.hpp"
#include "kernels/dispatch.hpp"

namespace torquescope::bench {
namespace {

using kernels::AlignedDoubles;

struct Case {
  std::string instruction_set;
  std::size_t n_regressors, n_samples, n_members;
  bool huber;
};

void run(benchmark::State& state, Case const& test) {
  kernels::force_instruction_set(test.instruction_set);
  kernels::SampleTiles const tiles = random_tiles(test.n_samples, test.n_regressors);
  std::vector<double> const members(test.n_members * test.n_regressors, 0.5);
  kernels::Candidates const candidates{members.data(), test.n_members, test.n_regressors};
  AlignedDoubles workspace(kernels::energy_workspace_size(test.n_samples, test.n_regressors, test.n_members));
  std::vector<double> energy(test.n_members);
  auto const evaluate = [&] {
    if (test.huber)
      kernels::huber_energy(tiles, candidates, 0.7, energy.data(), workspace.data());
    else
      kernels::residual_energy(tiles, candidates, energy.data(), workspace.data());
  };
  double const fma = static_cast<double>(test.n_samples * test.n_members * (test.n_regressors + 1));
  measure(state, {test.n_samples, test.n_members, fma}, evaluate);
  // what the sweep reads of the memory, and what a loop that only reads gets of it right after
  double const bytes_per_value = static_cast<double>((test.n_regressors + 1) * sizeof(double));
  state.counters["sweep_gb_per_s"] =
      bytes_per_value / (state.counters["ns_per_sample_candidate"] * static_cast<double>(test.n_members));
  state.counters["read_gb_per_s"] =
      1e-9 * read_bytes_per_second(tiles.data, kernels::packed_size(test.n_samples, test.n_regressors));
  kernels::release_instruction_set();
}

void add(Case const& test) {
  add_benchmark(case_name(test.huber ? "huber_energy" : "residual_energy", test.instruction_set, test.n_regressors,
                          test.n_samples, test.n_members),
                turns_for(test.n_samples), [test](benchmark::State& state) { run(state, test); });
}

}  // namespace

void add_residual_energy_benchmarks(std::vector<std::string> const& instruction_sets) {
  for (std::size_t n_samples : {10'000, 1'000'000, 10'000'000})
    for (std::size_t n_regressors : {4, 11, 24, 60})
      for (auto const& name : instruction_sets) add({name, n_regressors, n_samples, 30, false});
  // what a sweep for several runs at once does (engine/experiment/runs/optimise.cpp)
  for (std::size_t n_samples : {1'000'000, 10'000'000})
    for (std::size_t n_regressors : {4, 11, 24, 60})
      for (auto const& name : instruction_sets) add({name, n_regressors, n_samples, 120, false});
  for (auto const& name : instruction_sets) add({name, 11, 10'000, 30, true});
}

}  // namespace torquescope::bench
