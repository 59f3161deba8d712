#include "kernels/philox.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/philox.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "kernels/philox-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {

// one block of n streams side by side, words: their counters; n at most the lanes of a vector
HWY_INLINE void block_of(PhiloxLanes words, Keys const& keys, std::size_t n, std::size_t n_blocks, std::uint32_t* out) {
  constexpr Wide wide;
  for (int round = 0; round < 10; ++round)
    words.round(hn::Set(wide, keys.word_0[round]), hn::Set(wide, keys.word_1[round]));
  // words 0, 1 and 2, 3 of a stream as one 64-bit number each, low word first as x86 stores it
  HWY_ALIGN std::uint64_t halves[2 * hn::MaxLanes(wide)];
  hn::StoreInterleaved2(joined(words.word_0, words.word_1), joined(words.word_2, words.word_3), wide, halves);
  for (std::size_t lane = 0; lane < n; ++lane)
    std::memcpy(out + lane * n_blocks * 4, halves + 2 * lane, 2 * sizeof(halves[0]));
}

void all_blocks(PhiloxStreams const& streams, std::size_t n_streams, std::size_t first_block, std::size_t n_blocks,
                std::uint32_t* out) {
  constexpr Wide wide;
  constexpr std::size_t lanes = hn::MaxLanes(wide);
  Keys const keys(streams.key[0], streams.key[1]);
  // made once: Highway 1.0.3 builds it through memory
  Words const lane = hn::Iota(wide, 0);
  Words const word_2 = hn::Set(wide, streams.word_2), word_3 = hn::Set(wide, streams.word_3);
  for (std::size_t first = 0; first < n_streams; first += lanes) {
    Words const member = hn::Add(hn::Set(wide, streams.first_word_1 + first), lane);
    for (std::size_t block = 0; block < n_blocks; ++block)
      block_of({hn::Set(wide, first_block + block), member, word_2, word_3}, keys, std::min(lanes, n_streams - first),
               n_blocks, out + (first * n_blocks + block) * 4);
  }
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

static_assert(std::endian::native == std::endian::little);

TORQUESCOPE_EXPORT(all_blocks);

}  // namespace

void philox_blocks(PhiloxStreams const& streams, std::size_t n_streams, std::size_t first_block, std::size_t n_blocks,
                   std::uint32_t* blocks) {
  TORQUESCOPE_DISPATCH(all_blocks)(streams, n_streams, first_block, n_blocks, blocks);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
