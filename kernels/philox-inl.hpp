// Ten rounds of Philox4x32 on vectors, one stream per lane; compiled once per instruction set, so no #pragma once.
//
// Shapes     one 32-bit word in each 64-bit lane: the product of two words is one instruction, and its halves stay in
//            their lane
// Source     kernels/philox.hpp

#include <cstdint>

#include "hwy/highway.h"
#include "kernels/philox.hpp"

#if defined(TORQUESCOPE_KERNELS_PHILOX_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TORQUESCOPE_KERNELS_PHILOX_INL
#undef TORQUESCOPE_KERNELS_PHILOX_INL
#else
#define TORQUESCOPE_KERNELS_PHILOX_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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

  Keys(std::uint32_t key_0, std::uint32_t key_1) {
    for (int round = 0; round < 10; ++round, key_0 += 0x9E3779B9u, key_1 += 0xBB67AE85u) {
      word_0[round] = key_0;
      word_1[round] = key_1;
    }
  }
};

// a counter before the rounds, a block of random words after them; what the upper halves of its lanes hold is of no use
struct PhiloxLanes {
  Words word_0, word_1, word_2, word_3;

  HWY_INLINE void round(Words key_0, Words key_1) {
    constexpr Wide wide;
    Words const product_0 = product(hn::Set(wide, 0xD2511F53u), word_0);
    Words const product_1 = product(hn::Set(wide, 0xCD9E8D57u), word_2);
    word_0 = hn::Xor(hn::Xor(hn::ShiftRight<32>(product_1), word_1), key_0);
    word_2 = hn::Xor(hn::Xor(hn::ShiftRight<32>(product_0), word_3), key_1);
    // of no harm either: products look at the lower halves only
    word_1 = product_1;
    word_3 = product_0;
  }
};

// Blocks of streams that differ in their second word alone: the other three are one number for all lanes, so the first
// two rounds and half of the third are scalar ones, but for one product that all blocks of a stream share.
class PhiloxBlocks {
 public:
  HWY_INLINE PhiloxBlocks(PhiloxStreams const& streams, Keys const& keys, Words stream)
      : keys_(keys),
        word_3_(streams.word_3),
        first_(std::uint64_t{multiplier_1} * streams.word_2),
        shared_(product(hn::Set(Wide(), std::uint64_t{multiplier_0}),
                        hn::Xor(stream, hn::Set(Wide(), (first_ >> 32) ^ keys.word_0[0])))) {}

  // after three rounds; the first word of the counter is `block`
  HWY_INLINE PhiloxLanes after_three_rounds(std::uint32_t block) const {
    constexpr Wide wide;
    std::uint64_t const first_0 = std::uint64_t{multiplier_0} * block;
    std::uint64_t const second_1 = multiplier_1 * low((first_0 >> 32) ^ word_3_ ^ keys_.word_1[0]);
    std::uint64_t const third_0 = multiplier_0 * low((second_1 >> 32) ^ first_ ^ keys_.word_0[1]);
    Words const word_2 = hn::Xor(hn::ShiftRight<32>(shared_), hn::Set(wide, low(first_0) ^ keys_.word_1[1]));
    Words const third_1 = product(hn::Set(wide, std::uint64_t{multiplier_1}), word_2);
    return {hn::Xor(hn::ShiftRight<32>(third_1), hn::Set(wide, low(second_1) ^ keys_.word_0[2])), third_1,
            hn::Xor(shared_, hn::Set(wide, (third_0 >> 32) ^ keys_.word_1[2])), hn::Set(wide, third_0)};
  }

 private:
  static constexpr std::uint64_t low(std::uint64_t number) { return number & 0xFFFFFFFFu; }
  static constexpr std::uint32_t multiplier_0 = 0xD2511F53u, multiplier_1 = 0xCD9E8D57u;

  Keys const& keys_;
  std::uint64_t word_3_, first_;
  Words shared_;
};

HWY_INLINE Words low_half(Words words) { return hn::And(words, hn::Set(Wide(), 0xFFFFFFFFu)); }
// two words as the 64 bits that a stream draws, the first word low
HWY_INLINE Words joined(Words first, Words second) { return hn::Or(low_half(first), hn::ShiftLeft<32>(second)); }

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
