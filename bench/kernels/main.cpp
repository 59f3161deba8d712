// Benchmarks of kernels/ on every instruction set of this machine that has FMA.
//
// Use        scripts/bench prints them as one table; any option of Google Benchmark works here

#include <benchmark/benchmark.h>

#include "bench/kernels/kernel_benchmarks.hpp"
#include "kernels/dispatch.hpp"

int main(int argc, char** argv) {
  using namespace torquescope;
  std::vector<std::string> with_fma;
  for (auto const name : kernels::supported_instruction_sets()) {
    kernels::force_instruction_set(name);
    if (kernels::instruction_set_has_fma()) with_fma.emplace_back(name);
  }
  kernels::release_instruction_set();
  bench::add_residual_energy_benchmarks(with_fma);
  bench::add_levelled_energy_benchmarks(with_fma);
  bench::add_gram_benchmarks(with_fma);
  bench::add_philox_benchmarks(with_fma);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
