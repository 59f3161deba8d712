#pragma once
// Which instruction set the kernels run on, and forcing one: for tests, benchmarks and `--target`.
//
// Names      Highway's, best first: "AVX3" (AVX-512 F, BW, CD, DQ, VL), "AVX2" (with FMA3), "SSE4", "SSSE3", "SCALAR"
// Promise    every one of them gives the same bits (tests/unit/kernels/residual_energy_bits.cpp)
// No FMA     "SSE4" and below call std::fma for each lane: 35 to 70 times slower than AVX2 when forced on a machine
//            with FMA, thousands of times with glibc's software fma (a processor before 2013): small jobs only
// Threads    instruction_set() from any thread; force_ and release_instruction_set() only while no kernel runs

#include <string_view>
#include <vector>

namespace torquescope::kernels {

// the one the next kernel call uses
std::string_view instruction_set();
// whether that one has fused multiply-add in hardware
bool instruction_set_has_fma();
// all that were compiled and that this machine can run, best first; not changed by forcing
std::vector<std::string_view> supported_instruction_sets();
// false, and nothing changed, when `name` is not one of supported_instruction_sets()
bool force_instruction_set(std::string_view name);
// back to the best one
void release_instruction_set();

}  // namespace torquescope::kernels
