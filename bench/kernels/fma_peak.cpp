#include "bench/kernels/fma_peak.hpp"

#include <time.h>

#include <cstddef>

#include "kernels/dispatch-inl.hpp"

// this file is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/kernels/fma_peak.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace torquescope::bench::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// returns the number of multiply-adds done; the call goes through a table, so none of them can be optimised away
double multiply_add(std::size_t n_rounds, double* sum_of_all) {
  hn::CappedTag<double, 8> const d;
  // two FMA units of latency 4 need 8; more than 12 do not fit the 16 registers of AVX2
  constexpr std::size_t n_accumulators = 12;
  auto const factor = hn::Set(d, 0.999), term = hn::Set(d, 1e-3);
  hn::Vec<decltype(d)> accumulator[n_accumulators];
#pragma GCC unroll 12
  for (std::size_t a = 0; a < n_accumulators; ++a) accumulator[a] = hn::Set(d, static_cast<double>(a));
  for (std::size_t round = 0; round < n_rounds; ++round) {
#pragma GCC unroll 12
    for (std::size_t a = 0; a < n_accumulators; ++a) accumulator[a] = hn::MulAdd(accumulator[a], factor, term);
  }
  auto sum = hn::Zero(d);
#pragma GCC unroll 12
  for (std::size_t a = 0; a < n_accumulators; ++a) sum = hn::Add(sum, accumulator[a]);
  hn::StoreU(sum, d, sum_of_all);
  return static_cast<double>(n_rounds * n_accumulators * hn::MaxLanes(d));
}

}  // namespace torquescope::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::bench {
namespace {

TORQUESCOPE_EXPORT(multiply_add);

}  // namespace

double thread_cpu_seconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void FmaRate::measure_for(double seconds) {
  double const begin = thread_cpu_seconds();
  double passed = 0.0;
  while (passed < seconds) {
    double result[8];
    count_ += TORQUESCOPE_DISPATCH(multiply_add)(60'000, result);
    passed = thread_cpu_seconds() - begin;
  }
  seconds_ += passed;
}

}  // namespace torquescope::bench
#endif  // HWY_ONCE
