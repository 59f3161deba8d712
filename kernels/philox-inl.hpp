// Ten rounds of Philox4x32 on vectors, one stream per lane; compiled once per instruction set, so no #pragma once.
//
// Shapes     one 32-bit word in each 64-bit lane: the product of two words is one instruction, and its halves stay in
//            their lane
// Source     kernels/philox.hpp

#include <cstdint>

#include "hwy/highway.h"

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

HWY_INLINE Words low_half(Words words) { return hn::And(words, hn::Set(Wide(), 0xFFFFFFFFu)); }
// two words as the 64 bits that a stream draws, the first word low
HWY_INLINE Words joined(Words first, Words second) { return hn::Or(low_half(first), hn::ShiftLeft<32>(second)); }

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
