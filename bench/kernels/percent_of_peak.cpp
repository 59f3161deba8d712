#include "bench/kernels/percent_of_peak.hpp"

#include <algorithm>
#include <cmath>

#include "bench/kernels/fma_peak.hpp"

namespace torquescope::bench {
namespace {

constexpr double turn_seconds = 0.005;

double seconds_of(std::size_t calls, std::function<void()> const& call) {
  double const begin = thread_cpu_seconds();
  for (std::size_t i = 0; i < calls; ++i) {
    call();
    benchmark::ClobberMemory();
  }
  return thread_cpu_seconds() - begin;
}

// calls that fill a turn
std::size_t calls_per_turn(std::function<void()> const& call) {
  std::size_t calls = 1;
  for (double seconds = seconds_of(1, call); seconds < turn_seconds / 4; seconds = seconds_of(calls, call)) calls *= 2;
  double const each = seconds_of(calls, call) / static_cast<double>(calls);
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(turn_seconds / each)));
}

}  // namespace

void measure(benchmark::State& state, Work const& work, std::function<void()> const& call) {
  call();  // first touch
  std::size_t const calls = calls_per_turn(call);
  double kernel_seconds = 0.0, kernel_calls = 0.0;
  FmaRate peak;
  for (auto _ : state) {
    double const seconds = seconds_of(calls, call);
    kernel_seconds += seconds;
    kernel_calls += static_cast<double>(calls);
    state.SetIterationTime(seconds / static_cast<double>(calls));
    peak.measure_for(std::max(turn_seconds, seconds) / 5);
  }
  double const rate = kernel_calls * work.useful_fma / kernel_seconds;
  state.counters["percent_of_peak"] = 100 * rate / peak.per_second();
  state.counters["ns_per_sample_candidate"] =
      1e9 * kernel_seconds / (kernel_calls * static_cast<double>(work.n_samples * work.n_candidates));
  state.counters["peak_gflops"] = 2e-9 * peak.per_second();
}

void add_benchmark(std::string const& name, int turns, std::function<void(benchmark::State&)> const& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime()
      ->Iterations(turns)
      ->Repetitions(5)
      ->ReportAggregatesOnly(true);
}

}  // namespace torquescope::bench
