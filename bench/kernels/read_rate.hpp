#pragma once
// What this thread gets from memory at this moment: bytes per second of reading and adding up an array, front to back.
//
// Method     wide loads, sixteen sums, nothing else; thread CPU time, which counts waiting for memory

#include <cstddef>

namespace torquescope::bench {

// one pass
double read_bytes_per_second(double const* numbers, std::size_t count);

}  // namespace torquescope::bench
