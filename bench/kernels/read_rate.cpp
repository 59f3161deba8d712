#include "bench/kernels/read_rate.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cstring>

#include "bench/kernels/fma_peak.hpp"

namespace torquescope::bench {

double read_bytes_per_second(double const* numbers, std::size_t count) {
  constexpr std::size_t n_sums = 16;
  using Pair [[gnu::vector_size(16)]] = double;
  std::array<Pair, n_sums> sums{};
  double const begin = thread_cpu_seconds();
  for (std::size_t i = 0; i + 2 * n_sums <= count; i += 2 * n_sums)
    for (std::size_t j = 0; j < n_sums; ++j) {
      Pair pair;
      std::memcpy(&pair, numbers + i + 2 * j, sizeof(pair));
      sums[j] += pair;
    }
  benchmark::DoNotOptimize(sums);
  return static_cast<double>(count * sizeof(double)) / (thread_cpu_seconds() - begin);
}

}  // namespace torquescope::bench
