#pragma once
// Every kernel's benchmarks, one function per file; main.cpp calls them all.

#include <cstddef>
#include <string>
#include <vector>

namespace torquescope::bench {

// instruction_sets: those with FMA, best first
void add_residual_energy_benchmarks(std::vector<std::string> const& instruction_sets);
void add_levelled_energy_benchmarks(std::vector<std::string> const& instruction_sets);
void add_gram_benchmarks(std::vector<std::string> const& instruction_sets);
void add_philox_benchmarks(std::vector<std::string> const& instruction_sets);

// "residual_energy/AVX2/R:4/n:10000/NP:30": what bench/table.py takes apart
inline std::string case_name(std::string const& kernel, std::string const& instruction_set, std::size_t n_regressors,
                             std::size_t n_samples, std::size_t n_members) {
  return kernel + "/" + instruction_set + "/R:" + std::to_string(n_regressors) + "/n:" + std::to_string(n_samples) +
         "/NP:" + std::to_string(n_members);
}

// turns with the peak loop: long recordings fill a turn with one call
inline int turns_for(std::size_t n_samples) { return n_samples < 100'000 ? 20 : n_samples < 5'000'000 ? 6 : 2; }

}  // namespace torquescope::bench
