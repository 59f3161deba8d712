#pragma once
// How a dataset is cut into chunks, the pieces that HDF5 reads, checks and compresses as a whole.
//
// Why        one chunk per run and at most 1 MiB was the fastest of ten layouts to write and to read back; many small
//            runs share a chunk of 64 KiB, because a chunk of 8 bytes costs as much as one of 8 KiB
// Shapes     the result has the rank of `shape`, each extent between 1 and that of `shape`
// Requires   no extent of `shape` is 0

#include <cstddef>
#include <vector>

namespace torquescope {

// chunks of several runs are at most this large
inline constexpr std::size_t shared_chunk_bytes = std::size_t{64} << 10;

// an array that is written and read as a whole: equal parts of at most 1 MiB along the first dimensions
std::vector<std::size_t> chunk_of_array(std::vector<std::size_t> shape, std::size_t bytes_per_value);

// [run][...]: one run, parts of a large run, or several small runs
std::vector<std::size_t> chunk_of_runs(std::vector<std::size_t> shape, std::size_t bytes_per_value);

}  // namespace torquescope
