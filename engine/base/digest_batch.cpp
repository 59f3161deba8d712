#include "engine/base/digest_batch.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/base/digest_pair.hpp"
#include "engine/base/sha256_constants.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
// GCC 12 finds the undefined vector that its own header passes for lanes nobody reads (bug 105593)
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
#endif

namespace torquescope {
namespace {

void by_pairs(std::span<std::byte const* const> texts, std::size_t bytes, Sha256* digests) {
  std::size_t i = 0;
  for (; i + 1 < texts.size(); i += 2) {
    auto const both = sha256_of_two({texts[i], bytes}, {texts[i + 1], bytes});
    digests[i] = both.first;
    digests[i + 1] = both.second;
  }
  if (i < texts.size()) digests[i] = Digest().bytes(texts[i], bytes).raw();
}

#if defined(__x86_64__)

using sha256::block_bytes;
using sha256::first_state;
using sha256::n_rounds;
using sha256::round_constants;
constexpr std::size_t n_lanes = 16;
// fewer are faster in pairs
constexpr std::size_t worth_lanes = 10;

#define TORQUESCOPE_AVX512 gnu::target("avx512f,avx512bw"), gnu::always_inline

template <int a, int b, int c>
[[TORQUESCOPE_AVX512]] inline __m512i rotations(__m512i x) {
  return _mm512_ternarylogic_epi32(_mm512_ror_epi32(x, a), _mm512_ror_epi32(x, b), _mm512_ror_epi32(x, c), 0x96);
}

// the last of the three is a shift
template <int a, int b, int c>
[[TORQUESCOPE_AVX512]] inline __m512i schedule_rotations(__m512i x) {
  return _mm512_ternarylogic_epi32(_mm512_ror_epi32(x, a), _mm512_ror_epi32(x, b), _mm512_srli_epi32(x, c), 0x96);
}

// row i, word j -> row j, word i
[[TORQUESCOPE_AVX512]] inline void transpose(__m512i (&row)[n_lanes]) {
  __m512i pairs[n_lanes];
#pragma GCC unroll 8
  for (std::size_t i = 0; i < n_lanes; i += 2) {
    pairs[i] = _mm512_unpacklo_epi32(row[i], row[i + 1]);
    pairs[i + 1] = _mm512_unpackhi_epi32(row[i], row[i + 1]);
  }
#pragma GCC unroll 4
  for (std::size_t i = 0; i < n_lanes; i += 4) {
    row[i] = _mm512_unpacklo_epi64(pairs[i], pairs[i + 2]);
    row[i + 1] = _mm512_unpackhi_epi64(pairs[i], pairs[i + 2]);
    row[i + 2] = _mm512_unpacklo_epi64(pairs[i + 1], pairs[i + 3]);
    row[i + 3] = _mm512_unpackhi_epi64(pairs[i + 1], pairs[i + 3]);
  }
  // row[4 g + k], quarter q: words 4 q + k of rows 4 g .. 4 g + 3
#pragma GCC unroll 4
  for (std::size_t k = 0; k < 4; ++k) {
    __m512i const low = _mm512_shuffle_i32x4(row[k], row[4 + k], 0x44);
    __m512i const high = _mm512_shuffle_i32x4(row[k], row[4 + k], 0xee);
    __m512i const low_of_last = _mm512_shuffle_i32x4(row[8 + k], row[12 + k], 0x44);
    __m512i const high_of_last = _mm512_shuffle_i32x4(row[8 + k], row[12 + k], 0xee);
    pairs[k] = _mm512_shuffle_i32x4(low, low_of_last, 0x88);
    pairs[4 + k] = _mm512_shuffle_i32x4(low, low_of_last, 0xdd);
    pairs[8 + k] = _mm512_shuffle_i32x4(high, high_of_last, 0x88);
    pairs[12 + k] = _mm512_shuffle_i32x4(high, high_of_last, 0xdd);
  }
#pragma GCC unroll 16
  for (std::size_t i = 0; i < n_lanes; ++i) row[i] = pairs[i];
}

// one block of each text
[[TORQUESCOPE_AVX512]] inline void compress(__m512i (&state)[8], std::byte const* const (&texts)[n_lanes],
                                            std::size_t offset) {
  __m512i const high_byte_first = _mm512_broadcast_i32x4(_mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203));
  __m512i w[n_lanes];
#pragma GCC unroll 16
  for (std::size_t lane = 0; lane < n_lanes; ++lane)
    w[lane] = _mm512_shuffle_epi8(_mm512_loadu_si512(texts[lane] + offset), high_byte_first);
  transpose(w);
  __m512i a = state[0], b = state[1], c = state[2], d = state[3], e = state[4], f = state[5], g = state[6],
          h = state[7];
#pragma GCC unroll 64
  for (std::size_t t = 0; t < n_rounds; ++t) {
    if (t >= 16) {
      __m512i const later = _mm512_add_epi32(schedule_rotations<17, 19, 10>(w[(t + 14) & 15]), w[(t + 9) & 15]);
      w[t & 15] = _mm512_add_epi32(_mm512_add_epi32(w[t & 15], schedule_rotations<7, 18, 3>(w[(t + 1) & 15])), later);
    }
    __m512i const constant = _mm512_set1_epi32(static_cast<int>(round_constants[t]));
    __m512i const chosen = _mm512_ternarylogic_epi32(e, f, g, 0xca), most = _mm512_ternarylogic_epi32(a, b, c, 0xe8);
    __m512i const first = _mm512_add_epi32(
        _mm512_add_epi32(_mm512_add_epi32(h, constant), _mm512_add_epi32(w[t & 15], chosen)), rotations<6, 11, 25>(e));
    h = g;
    g = f;
    f = e;
    e = _mm512_add_epi32(d, first);
    d = c;
    c = b;
    b = a;
    a = _mm512_add_epi32(first, _mm512_add_epi32(rotations<2, 13, 22>(b), most));
  }
  __m512i const after[8] = {a, b, c, d, e, f, g, h};
#pragma GCC unroll 8
  for (std::size_t i = 0; i < 8; ++i) state[i] = _mm512_add_epi32(state[i], after[i]);
}

// up to sixteen texts; lanes without one repeat the first
[[gnu::target("avx512f,avx512bw")]] void by_lanes(std::span<std::byte const* const> texts, std::size_t bytes,
                                                  Sha256* digests) {
  std::byte const* text[n_lanes];
  for (std::size_t lane = 0; lane < n_lanes; ++lane) text[lane] = texts[lane < texts.size() ? lane : 0];
  __m512i state[8];
  for (std::size_t i = 0; i < 8; ++i) state[i] = _mm512_set1_epi32(static_cast<int>(first_state[i]));
  std::size_t const whole = bytes / block_bytes * block_bytes;
  for (std::size_t offset = 0; offset < whole; offset += block_bytes) compress(state, text, offset);

  // what is left of each, the end mark and the length
  std::size_t const rest = bytes - whole, last_bytes = rest + 9 > block_bytes ? 2 * block_bytes : block_bytes;
  std::byte last[n_lanes][2 * block_bytes] = {};
  for (std::size_t lane = 0; lane < n_lanes; ++lane) {
    std::memcpy(last[lane], text[lane] + whole, rest);
    last[lane][rest] = std::byte{0x80};
    for (std::size_t i = 0; i < 8; ++i)
      last[lane][last_bytes - 1 - i] = static_cast<std::byte>(std::uint64_t{bytes} * 8 >> 8 * i);
    text[lane] = last[lane];
  }
  for (std::size_t offset = 0; offset < last_bytes; offset += block_bytes) compress(state, text, offset);

  alignas(64) std::uint32_t words[8][n_lanes];
  for (std::size_t i = 0; i < 8; ++i) _mm512_store_si512(words[i], state[i]);
  for (std::size_t lane = 0; lane < texts.size(); ++lane)
    for (std::size_t i = 0; i < digests[lane].size(); ++i)
      digests[lane][i] = static_cast<unsigned char>(words[i / 4][lane] >> (24 - 8 * (i % 4)));
}

bool has_lanes() {
  static bool const has = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0;
  return has;
}

#endif

}  // namespace

std::size_t texts_side_by_side() {
#if defined(__x86_64__)
  // AMD's two at a time are as fast as its sixteen, and nothing waits in memory for fourteen others
  static bool const wants_lanes = has_lanes() && __builtin_cpu_is("amd") == 0;
  if (wants_lanes) return n_lanes;
#endif
  return 2;
}

void sha256_of_each(std::span<std::byte const* const> texts, std::size_t bytes, Sha256* digests) {
#if defined(__x86_64__)
  while (texts.size() >= worth_lanes && has_lanes()) {
    std::size_t const together = std::min(n_lanes, texts.size());
    by_lanes(texts.first(together), bytes, digests);
    texts = texts.subspan(together);
    digests += together;
  }
#endif
  by_pairs(texts, bytes, digests);
}

Sha256 sha256_by_blocks(std::span<std::byte const> bytes) {
  std::size_t const n_whole = bytes.size() / long_digest_block_bytes;
  std::vector<std::byte const*> blocks;
  for (std::size_t i = 0; i < n_whole; ++i) blocks.push_back(bytes.data() + i * long_digest_block_bytes);
  std::vector<Sha256> digests(n_whole);
  sha256_of_each(blocks, long_digest_block_bytes, digests.data());
  auto const rest = bytes.subspan(n_whole * long_digest_block_bytes);
  if (!rest.empty()) digests.push_back(Digest().bytes(rest.data(), rest.size()).raw());
  Digest digest;
  for (auto const& one : digests) digest.bytes(one.data(), one.size());
  return digest.raw();
}

}  // namespace torquescope
