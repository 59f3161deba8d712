#pragma once
// Random numbers that are addressed, not drawn in turn: (seed, domain, run, generation, member, draw) names one number.
//
// Equation   Philox4x32-10; key = (seed low, seed high), counter = (draw block, member, generation, domain << 24 | run)
// Promise    equal to Random123's philox4x32 bit for bit; independent of threads, shards and the order of calls
// Range      run < 2^24; member and generation < 2^32
// Threads    a RandomStream is a small value; make one per member where it is used
// Source     Salmon, Moraes, Dror, Shaw: Parallel random numbers: as easy as 1, 2, 3 (SC'11)

#include <array>
#include <cstdint>
#include <span>

namespace torquescope {

using PhiloxBlock = std::array<std::uint32_t, 4>;

// ten rounds of Philox4x32
PhiloxBlock philox4x32(PhiloxBlock counter, std::array<std::uint32_t, 2> key);

// keeps streams of different purposes apart under the same seed
enum class RandomDomain : std::uint32_t { optimiser = 0, simulation = 1, resampling = 2, test = 3, twin = 4 };

struct RandomKey {
  std::uint64_t seed = 0;
  std::uint32_t run = 0;
  RandomDomain domain = RandomDomain::optimiser;
};

class RandomStream {
 public:
  RandomStream(RandomKey key, std::uint32_t generation, std::uint32_t member);
  // the same stream; its first blocks, four words each, were computed before (kernels/philox.hpp) and must outlive it
  RandomStream(RandomKey key, std::uint32_t generation, std::uint32_t member,
               std::span<std::uint32_t const> first_blocks);

  // counter of its first block, and the key of all
  static PhiloxBlock first_counter(RandomKey key, std::uint32_t generation, std::uint32_t member);
  static std::array<std::uint32_t, 2> philox_key(RandomKey key);

  std::uint64_t bits();                     // 64 random bits
  double uniform();                         // [0, 1), 53 bits
  double uniform(double low, double high);  // low + uniform() * (high - low)
  std::uint32_t below(std::uint32_t n);     // 0 .. n-1, unbiased to 2^-32 (multiply-shift); n >= 1
  double normal();                          // standard normal, inverse cumulative distribution of one uniform

 private:
  void next_block();

  std::array<std::uint32_t, 2> key_;
  PhiloxBlock counter_;
  std::span<std::uint32_t const> first_blocks_{};
  PhiloxBlock block_{};
  std::uint32_t used_ = 4;  // 32-bit words taken from block_
};

}  // namespace torquescope
