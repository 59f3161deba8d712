#pragma once
// Philox4x32-10 of many counters at once: blocks of many neighbouring streams.
//
// Equation   blocks[i][b] = philox4x32-10(counter = (first_block + b, first_word_1 + i, word_2, word_3), key), as
//            Random123 numbers its words
// Shapes     blocks: n_streams x n_blocks x 4 words of 32 bits
// Bits       integers: the same on every instruction set, equal to engine/base/random_stream.hpp's philox4x32
// Range      first_word_1 + n_streams <= 2^32, first_block + n_blocks <= 2^32
// Threads    any number; does not allocate
// Source     Salmon, Moraes, Dror, Shaw: Parallel random numbers: as easy as 1, 2, 3 (SC'11)

#include <cstddef>
#include <cstdint>

namespace torquescope::kernels {

struct PhiloxStreams {
  std::uint32_t key[2] = {0, 0};
  std::uint32_t first_word_1 = 0;
  std::uint32_t word_2 = 0;
  std::uint32_t word_3 = 0;
};

void philox_blocks(PhiloxStreams const& streams, std::size_t n_streams, std::size_t first_block, std::size_t n_blocks,
                   std::uint32_t* blocks);

}  // namespace torquescope::kernels
