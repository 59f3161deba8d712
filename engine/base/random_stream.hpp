#pragma once
// Random numbers that are addressed, not drawn in turn: (seed, domain, run, generation, member, draw) names one number.
//
// Equation   Philox4x32-10; key = (seed low, seed high), counter = (draw block, member, generation, domain << 24 | run)
// Promise    equal to Random123's philox4x32 bit for bit; independent of threads, shards and the order of calls
// Range      run < 2^24; member and generation < 2^32
// Threads    a RandomStream is a small value; make one per member where it is used
// Source     Salmon, Moraes, Dror, Shaw: Parallel random numbers: as easy as 1, 2, 3 (SC'11)

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/base/contract.hpp"

namespace torquescope {

using PhiloxBlock = std::array<std::uint32_t, 4>;

// ten rounds of Philox4x32
PhiloxBlock philox4x32(PhiloxBlock counter, std::array<std::uint32_t, 2> key);

// keeps streams of different purposes apart under the same seed
enum class RandomDomain : std::uint32_t { optimiser = 0, simulation = 1, resampling = 2, test = 3, replicate = 4 };

struct RandomKey {
  std::uint64_t seed = 0;
  std::uint32_t run = 0;
  RandomDomain domain = RandomDomain::optimiser;
};

class RandomStream {
 public:
  RandomStream(RandomKey key, std::uint32_t generation, std::uint32_t member)
      : key_(philox_key(key)), counter_(first_counter(key, generation, member)) {}
  // counter of its first block, and the key of all
  static PhiloxBlock first_counter(RandomKey key, std::uint32_t generation, std::uint32_t member) {
    TORQUESCOPE_EXPECT(key.run < (1u << 24));
    return {0, member, generation, (static_cast<std::uint32_t>(key.domain) << 24) | key.run};
  }
  static std::array<std::uint32_t, 2> philox_key(RandomKey key) {
    return {static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)};
  }

  // 64 random bits
  std::uint64_t bits();
  // as if bits() had been called n_draws times
  void skip(std::size_t n_draws);
  // [0, 1), 53 bits; signed because x86 converts signed numbers in one instruction
  double uniform() { return static_cast<double>(static_cast<std::int64_t>(bits() >> 11)) * 0x1.0p-53; }
  // low + uniform() * (high - low)
  double uniform(double low, double high) { return low + uniform() * (high - low); }
  // 0 .. n-1, unbiased to 2^-32 (multiply-shift); n >= 1
  std::uint32_t below(std::uint32_t n) {
    TORQUESCOPE_EXPECT(n >= 1);
    return static_cast<std::uint32_t>(((bits() >> 32) * n) >> 32);
  }
  // standard normal, inverse cumulative distribution of one uniform
  double normal();
  // the uniform that these bits stand for: the middle of one of 2^53 cells, never 0 or 1
  static double probability(std::uint64_t bits) {
    return (static_cast<double>(static_cast<std::int64_t>(bits >> 11)) + 0.5) * 0x1.0p-53;
  }

 private:
  void compute_block();

  std::array<std::uint32_t, 2> key_;
  PhiloxBlock counter_;
  std::size_t next_word_ = 0;  // of the stream
  PhiloxBlock block_{};        // holds it unless it is the first of a block
};

}  // namespace torquescope
