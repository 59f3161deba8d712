#include "engine/base/digest_pair.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "engine/base/sha256_constants.hpp"

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>
#endif

namespace torquescope {
namespace {

using Bytes = std::span<std::byte const>;
using sha256::block_bytes;
using sha256::round_constants;

Sha256 one(Bytes bytes) { return Digest().bytes(bytes.data(), bytes.size()).raw(); }

#if defined(__x86_64__)

// FIPS 180-4, 5.3.3, in the order of the instructions: words a b e f and c d g h, the first one highest
struct State {
  alignas(16) std::uint32_t abef[4] = {0x9b05688c, 0x510e527f, 0xbb67ae85, 0x6a09e667};
  alignas(16) std::uint32_t cdgh[4] = {0x5be0cd19, 0x1f83d9ab, 0xa54ff53a, 0x3c6ef372};
};

// the same number of blocks of each text, step by step beside each other
template <std::size_t n_texts>
[[gnu::target("sha,sse4.1,ssse3")]] void compress(State* const* states, std::byte const* const* texts,
                                                  std::size_t n_blocks) {
  __m128i const high_byte_first = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
  auto const load = [](void const* from) { return _mm_loadu_si128(static_cast<__m128i const*>(from)); };
  __m128i abef[n_texts], cdgh[n_texts];
  for (std::size_t t = 0; t < n_texts; ++t) {
    abef[t] = load(states[t]->abef);
    cdgh[t] = load(states[t]->cdgh);
  }
  for (std::size_t block = 0; block < n_blocks; ++block) {
    __m128i before_abef[n_texts], before_cdgh[n_texts], words[n_texts][4];
    for (std::size_t t = 0; t < n_texts; ++t) {
      before_abef[t] = abef[t];
      before_cdgh[t] = cdgh[t];
    }
    // four rounds each; words i + 4 .. come from words i .. i + 3 on the way
#pragma GCC unroll 16
    for (int i = 0; i < 16; ++i) {
#pragma GCC unroll 2
      for (std::size_t t = 0; t < n_texts; ++t) {
        __m128i* const w = words[t];
        if (i < 4) w[i] = _mm_shuffle_epi8(load(texts[t] + block * block_bytes + 16 * i), high_byte_first);
        __m128i sum = _mm_add_epi32(w[i & 3], load(round_constants + 4 * i));
        cdgh[t] = _mm_sha256rnds2_epu32(cdgh[t], abef[t], sum);
        if (i >= 3 && i < 15) {
          __m128i& next = w[(i + 1) & 3];
          next = _mm_add_epi32(next, _mm_alignr_epi8(w[i & 3], w[(i - 1) & 3], 4));
          next = _mm_sha256msg2_epu32(next, w[i & 3]);
        }
        sum = _mm_shuffle_epi32(sum, 0x0e);
        abef[t] = _mm_sha256rnds2_epu32(abef[t], cdgh[t], sum);
        if (i >= 1 && i < 13) w[(i - 1) & 3] = _mm_sha256msg1_epu32(w[(i - 1) & 3], w[i & 3]);
      }
    }
    for (std::size_t t = 0; t < n_texts; ++t) {
      abef[t] = _mm_add_epi32(abef[t], before_abef[t]);
      cdgh[t] = _mm_add_epi32(cdgh[t], before_cdgh[t]);
    }
  }
  for (std::size_t t = 0; t < n_texts; ++t) {
    _mm_store_si128(reinterpret_cast<__m128i*>(states[t]->abef), abef[t]);
    _mm_store_si128(reinterpret_cast<__m128i*>(states[t]->cdgh), cdgh[t]);
  }
}

void compress_one(State& state, std::byte const* text, std::size_t n_blocks) {
  State* const states[] = {&state};
  std::byte const* const texts[] = {text};
  compress<1>(states, texts, n_blocks);
}

// what is left of a text behind its first `done` bytes, the end mark and the length
Sha256 finish(State& state, Bytes text, std::size_t done) {
  std::size_t const whole = (text.size() - done) / block_bytes;
  compress_one(state, text.data() + done, whole);
  done += whole * block_bytes;
  std::size_t const rest = text.size() - done, last_blocks = rest + 9 > block_bytes ? 2 : 1;
  std::byte last[2 * block_bytes] = {};
  std::copy(text.begin() + static_cast<std::ptrdiff_t>(done), text.end(), last);
  last[rest] = std::byte{0x80};
  for (int i = 0; i < 8; ++i)
    last[last_blocks * block_bytes - 1 - static_cast<std::size_t>(i)] =
        static_cast<std::byte>(std::uint64_t{text.size()} * 8 >> 8 * i);
  compress_one(state, last, last_blocks);
  std::uint32_t const words[8] = {state.abef[3], state.abef[2], state.cdgh[3], state.cdgh[2],
                                  state.abef[1], state.abef[0], state.cdgh[1], state.cdgh[0]};
  Sha256 digest{};
  for (std::size_t i = 0; i < digest.size(); ++i)
    digest[i] = static_cast<unsigned char>(words[i / 4] >> (24 - 8 * (i % 4)));
  return digest;
}

bool has_sha_instructions() {
  static bool const has = [] {
    unsigned a = 0, b = 0, c = 0, d = 0;
    constexpr unsigned sha = 1u << 29;
    return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b & sha) != 0 && __builtin_cpu_supports("sse4.1") != 0;
  }();
  return has;
}

Sha256Pair both(Bytes first, Bytes second) {
  State of_first, of_second;
  std::size_t const blocks = std::min(first.size(), second.size()) / block_bytes;
  State* const states[] = {&of_first, &of_second};
  std::byte const* const texts[] = {first.data(), second.data()};
  compress<2>(states, texts, blocks);
  return {finish(of_first, first, blocks * block_bytes), finish(of_second, second, blocks * block_bytes)};
}

#else

bool has_sha_instructions() { return false; }
Sha256Pair both(Bytes first, Bytes second) { return {one(first), one(second)}; }

#endif

}  // namespace

Sha256Pair sha256_of_two(Bytes first, Bytes second) {
  return has_sha_instructions() ? both(first, second) : Sha256Pair{one(first), one(second)};
}

}  // namespace torquescope
