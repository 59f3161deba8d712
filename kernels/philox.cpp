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

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// one 32-bit word in each 64-bit lane: the product of two words is one instruction, and its halves stay in their lane
using Wide = hn::CappedTag<std::uint64_t, 8>;
using Words = hn::Vec<Wide>;

// low halves of a times low halves of b, 64 bits
HWY_INLINE Words product(Words a, Words b) {
  hn::RepartitionToNarrow<Wide> const narrow;
#if HWY_TARGET == HWY_SCALAR
  (void)narrow;
  return Words((a.raw & 0xFFFFFFFFu) * (b.raw & 0xFFFFFFFFu));
#else
  return hn::MulEven(hn::BitCast(narrow, a), hn::BitCast(narrow, b));
#endif
}

// of each round
struct Keys {
  std::uint64_t word_0[10], word_1[10];
};

// one block of n streams side by side, from stream first on; n at most the lanes of a vector
HWY_INLINE void block_of(PhiloxStreams const& streams, Keys const& keys, Words word_1, std::size_t first, std::size_t n,
                         std::size_t block, std::size_t n_blocks, std::uint32_t* out) {
  constexpr Wide wide;
  Words const multiplier_0 = hn::Set(wide, 0xD2511F53u), multiplier_1 = hn::Set(wide, 0xCD9E8D57u);
  Words c0 = hn::Set(wide, block), c1 = word_1, c2 = hn::Set(wide, streams.word_2), c3 = hn::Set(wide, streams.word_3);
  for (int round = 0; round < 10; ++round) {
    Words const product_0 = product(multiplier_0, c0), product_1 = product(multiplier_1, c2);
    c0 = hn::Xor(hn::Xor(hn::ShiftRight<32>(product_1), c1), hn::Set(wide, keys.word_0[round]));
    c2 = hn::Xor(hn::Xor(hn::ShiftRight<32>(product_0), c3), hn::Set(wide, keys.word_1[round]));
    // the upper halves are of no use and of no harm: products look at the lower ones only
    c1 = product_1;
    c3 = product_0;
  }
  Words const low = hn::Set(wide, 0xFFFFFFFFu);
  // words 0, 1 and 2, 3 of a stream as one 64-bit number each, low word first as x86 stores it
  HWY_ALIGN std::uint64_t halves[2 * hn::MaxLanes(wide)];
  hn::StoreInterleaved2(hn::Or(hn::And(c0, low), hn::ShiftLeft<32>(c1)),
                        hn::Or(hn::And(c2, low), hn::ShiftLeft<32>(c3)), wide, halves);
  for (std::size_t lane = 0; lane < n; ++lane)
    std::memcpy(out + ((first + lane) * n_blocks + block) * 4, halves + 2 * lane, 2 * sizeof(halves[0]));
}

void all_blocks(PhiloxStreams const& streams, std::size_t n_streams, std::size_t n_blocks, std::uint32_t* out) {
  constexpr std::size_t lanes = hn::MaxLanes(Wide());
  Keys keys;
  std::uint32_t key_0 = streams.key[0], key_1 = streams.key[1];
  for (int round = 0; round < 10; ++round, key_0 += 0x9E3779B9u, key_1 += 0xBB67AE85u) {
    keys.word_0[round] = key_0;
    keys.word_1[round] = key_1;
  }
  // made once: Highway 1.0.3 builds it through memory
  Words const lane = hn::Iota(Wide(), 0);
  for (std::size_t first = 0; first < n_streams; first += lanes) {
    Words const member = hn::Add(hn::Set(Wide(), streams.first_word_1 + first), lane);
    for (std::size_t block = 0; block < n_blocks; ++block)
      block_of(streams, keys, member, first, std::min(lanes, n_streams - first), block, n_blocks, out);
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

void philox_blocks(PhiloxStreams const& streams, std::size_t n_streams, std::size_t n_blocks, std::uint32_t* blocks) {
  TORQUESCOPE_DISPATCH(all_blocks)(streams, n_streams, n_blocks, blocks);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
