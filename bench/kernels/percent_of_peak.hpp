#pragma once
// One measurement: a kernel and the FMA peak in turns, in the same thread, so that frequency and neighbours hit both.
//
// Method     a turn is at least 5 ms of kernel, then a burst of the peak loop of about a fifth of that; both are summed
//            over the turns and compared as rates. Thread CPU time.
// Counters   percent_of_peak (useful multiply-adds), ns_per_sample_candidate, peak_gflops
// Reads      bench/table.py

#include <benchmark/benchmark.h>

#include <cstddef>
#include <functional>
#include <string>

namespace torquescope::bench {

struct Work {
  std::size_t n_samples = 0;
  std::size_t n_candidates = 1;  // 1 for a kernel that knows none
  double useful_fma = 0.0;       // of one call
};

// runs `call` in turns with the peak loop; one iteration of `state` is one turn
void measure(benchmark::State& state, Work const& work, std::function<void()> const& call);

// registers five repetitions of `turns` turns
void add_benchmark(std::string const& name, int turns, std::function<void(benchmark::State&)> const& run);

}  // namespace torquescope::bench
