// One sweep for the statistics, and an evaluation from them.
//
// Counts     gram: R (R + 3) / 2 + 1 multiply-adds per sample (every pair once), plus R (R + 1) / 2 + R when whitened;
//            ns_per_sample_candidate is per sample. quadratic_energy: n counts for nothing; ns per candidate

#include "kernels/gram.hpp"

#include <string>
#include <vector>

#include "bench/kernels/kernel_benchmarks.hpp"
#include "bench/kernels/percent_of_peak.hpp"
#include "bench/kernels/random_tiles.hpp"
#include "kernels/aligned_doubles.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/quadratic_energy.hpp"

namespace torquescope::bench {
namespace {

std::vector<double> unit_matrix(std::size_t n) {
  std::vector<double> matrix(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) matrix[i * n + i] = 1.0;
  return matrix;
}

void run_gram(benchmark::State& state, std::string const& instruction_set, std::size_t n, std::size_t n_samples,
              bool whitened) {
  kernels::force_instruction_set(instruction_set);
  // any numbers will do: the packed ones, read as columns
  double const* const numbers = random_tiles(n_samples, n).data;
  kernels::SampleColumns const samples{numbers, n_samples, numbers + n * n_samples, n_samples, n};
  auto const root = unit_matrix(n);
  std::vector<double> const centre(n, 0.5);
  std::vector<double> sums((n + 1) * (n + 1));
  kernels::AlignedDoubles workspace(kernels::gram_workspace_size(n_samples, n));
  double const pairs = static_cast<double>(n * (n + 3) / 2 + 1), white = static_cast<double>(n * (n + 1) / 2 + n);
  measure(state, {n_samples, 1, static_cast<double>(n_samples) * (whitened ? pairs + white : pairs)}, [&] {
    if (whitened)
      kernels::whitened_gram(samples, root.data(), centre.data(), sums.data(), workspace.data());
    else
      kernels::gram(samples, sums.data(), workspace.data());
  });
  kernels::release_instruction_set();
}

void run_quadratic(benchmark::State& state, std::string const& instruction_set, std::size_t n) {
  constexpr std::size_t n_members = 30;
  kernels::force_instruction_set(instruction_set);
  auto const root = unit_matrix(n);
  std::vector<double> const low(n * n, 1e-17), centre(n, 0.25), members(n_members * n, 0.5);
  std::vector<double> energy(n_members);
  kernels::AlignedDoubles workspace(kernels::quadratic_workspace_size(n));
  kernels::QuadraticForm const form{n, centre.data(), root.data(), low.data(), centre.data(), 1.0};
  measure(state, {1, n_members, static_cast<double>(n_members * (n * (n + 5) / 2))}, [&] {
    kernels::quadratic_energy(form, {members.data(), n_members, n}, energy.data(), workspace.data());
  });
  kernels::release_instruction_set();
}

}  // namespace

void add_gram_benchmarks(std::vector<std::string> const& instruction_sets) {
  for (std::size_t n_samples : {10'000, 1'000'000}) {
    for (std::size_t n : {4, 11, 24, 60}) {
      for (auto const& name : instruction_sets) {
        for (bool const whitened : {false, true})
          add_benchmark(case_name(whitened ? "whitened_gram" : "gram", name, n, n_samples, 1), turns_for(n_samples),
                        [=](benchmark::State& state) { run_gram(state, name, n, n_samples, whitened); });
      }
    }
  }
  for (std::size_t n : {4, 11, 24, 60})
    for (auto const& name : instruction_sets)
      add_benchmark(case_name("quadratic_energy", name, n, 1, 30), turns_for(1),
                    [=](benchmark::State& state) { run_quadratic(state, name, n); });
}

}  // namespace torquescope::bench
