// The energy kernels against the FMA peak of the same thread, measured just before each repetition.
//
// Counts     R + 1 useful multiply-adds per sample and candidate (dot product, square); padding is not counted
// Read       percent_of_peak, ns_per_sample_candidate; medians of the repetitions; thread CPU time
// Use        bench_residual_energy --benchmark_filter=AVX2/R:4/

#include <benchmark/benchmark.h>

#include <random>
#include <string>
#include <vector>

#include "bench/kernels/fma_peak.hpp"
#include "kernels/aligned_doubles.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/residual_energy.hpp"
#include "kernels/sample_tiles.hpp"

namespace torquescope::bench {
namespace {

using kernels::AlignedDoubles;

struct Case {
  std::string_view instruction_set;
  std::size_t n_regressors, n_samples, n_members;
  bool huber;
};

// columns repeat every 4096 samples: filling them is not what we measure
AlignedDoubles random_tiles(std::size_t n_samples, std::size_t n_regressors) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> source(4096);
  for (double& number : source) number = uniform(random);
  AlignedDoubles packed(kernels::packed_size(n_samples, n_regressors));
  for (std::size_t i = 0; i < packed.size(); ++i) packed[i] = source[i * 7 % 4096];
  return packed;
}

void run(benchmark::State& state, Case const& test) {
  kernels::force_instruction_set(test.instruction_set);
  auto const packed = random_tiles(test.n_samples, test.n_regressors);
  kernels::SampleTiles const tiles{packed.data(), test.n_samples, test.n_regressors};
  std::vector<double> const members(test.n_members * test.n_regressors, 0.5);
  kernels::Candidates const candidates{members.data(), test.n_members, test.n_regressors};
  AlignedDoubles workspace(kernels::energy_workspace_size(test.n_samples, test.n_regressors, test.n_members));
  std::vector<double> energy(test.n_members);
  auto const evaluate = [&] {
    if (test.huber)
      kernels::huber_energy(tiles, candidates, 0.7, energy.data(), workspace.data());
    else
      kernels::residual_energy(tiles, candidates, energy.data(), workspace.data());
    benchmark::DoNotOptimize(energy.data());
    benchmark::ClobberMemory();
  };

  evaluate();  // first touch
  double const peak = fma_per_second();
  double const begin = thread_cpu_seconds();
  for (auto _ : state) evaluate();
  double const seconds = thread_cpu_seconds() - begin;

  double const evaluations =
      static_cast<double>(state.iterations()) * static_cast<double>(test.n_samples * test.n_members);
  state.counters["percent_of_peak"] = 100 * evaluations * static_cast<double>(test.n_regressors + 1) / seconds / peak;
  state.counters["ns_per_sample_candidate"] = 1e9 * seconds / evaluations;
  state.counters["peak_gflops"] = 2e-9 * peak;
  kernels::release_instruction_set();
}

void add(Case const& test) {
  std::string const name = std::string(test.huber ? "huber_energy/" : "residual_energy/") +
                           std::string(test.instruction_set) + "/R:" + std::to_string(test.n_regressors) +
                           "/n:" + std::to_string(test.n_samples) + "/NP:" + std::to_string(test.n_members);
  benchmark::RegisterBenchmark(name.c_str(), [test](benchmark::State& state) { run(state, test); })
      ->Unit(benchmark::kMillisecond)
      ->MinTime(0.1)
      ->Repetitions(5)
      ->ReportAggregatesOnly(true);
}

}  // namespace
}  // namespace torquescope::bench

int main(int argc, char** argv) {
  using namespace torquescope;
  for (auto const name : kernels::supported_instruction_sets()) {
    kernels::force_instruction_set(name);
    if (!kernels::instruction_set_has_fma()) continue;
    for (std::size_t n_samples : {10'000, 1'000'000})
      for (std::size_t n_regressors : {4, 11, 24, 60}) bench::add({name, n_regressors, n_samples, 30, false});
    bench::add({name, 11, 10'000, 30, true});
  }
  kernels::release_instruction_set();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
