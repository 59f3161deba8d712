#pragma once
// SHA-256 of many texts of one length: sixteen side by side in the lanes of AVX-512 where the processor has it, else
// two (digest_pair.hpp).
//
// Speed      16 blocks of 64 KiB on an Intel Xeon (Sapphire Rapids or later): 3.6 GB/s; in pairs 2.2, one by one 1.7.
//            On an AMD EPYC (Zen 4) 3.4, 3.3, 1.8
// Threads    free functions

#include <span>

#include "engine/base/digest.hpp"

namespace torquescope {

// how many texts together cost least, each
std::size_t texts_side_by_side();

// texts: where each begins; digests: as many
void sha256_of_each(std::span<std::byte const* const> texts, std::size_t bytes, Sha256* digests);

// of a long array: the SHA-256 over the SHA-256 of each of its blocks of 64 KiB, the last one of what is left
inline constexpr std::size_t long_digest_block_bytes = std::size_t{64} << 10;
Sha256 sha256_by_blocks(std::span<std::byte const> bytes);

}  // namespace torquescope
