// Random numbers of one generation: 30 members, five blocks each.
//
// Counts     ns_per_sample_candidate is per double (two words of 32 bits); there is no multiply-add to compare with

#include "kernels/philox.hpp"

#include <vector>

#include "bench/kernels/kernel_benchmarks.hpp"
#include "bench/kernels/percent_of_peak.hpp"
#include "kernels/dispatch.hpp"

namespace torquescope::bench {

void add_philox_benchmarks(std::vector<std::string> const& instruction_sets) {
  constexpr std::size_t n_members = 30, n_blocks = 5, n_doubles = 2 * n_members * n_blocks;
  for (auto const& name : instruction_sets) {
    add_benchmark(case_name("philox", name, n_blocks, n_doubles, n_members), turns_for(1),
                  [name](benchmark::State& state) {
                    kernels::force_instruction_set(name);
                    std::vector<std::uint32_t> words(2 * n_doubles);
                    kernels::PhiloxStreams const streams{{1, 2}, 0, 3, 4};
                    measure(state, {n_doubles, 1, 0.0},
                            [&] { kernels::philox_blocks(streams, n_members, 0, n_blocks, words.data()); });
                    kernels::release_instruction_set();
                  });
  }
}

}  // namespace torquescope::bench
