#include "engine/base/random_stream.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/base/contract.hpp"
#include "engine/base/portable_math.hpp"

namespace torquescope {

PhiloxBlock philox4x32(PhiloxBlock counter, std::array<std::uint32_t, 2> key) {
  constexpr std::uint64_t multiplier_0 = 0xD2511F53u;
  constexpr std::uint64_t multiplier_1 = 0xCD9E8D57u;
  constexpr std::uint32_t weyl_0 = 0x9E3779B9u;
  constexpr std::uint32_t weyl_1 = 0xBB67AE85u;
  for (int round = 0; round < 10; ++round) {
    std::uint64_t const product_0 = multiplier_0 * counter[0];
    std::uint64_t const product_1 = multiplier_1 * counter[2];
    counter = {static_cast<std::uint32_t>(product_1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(product_1),
               static_cast<std::uint32_t>(product_0 >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(product_0)};
    key = {key[0] + weyl_0, key[1] + weyl_1};
  }
  return counter;
}

PhiloxBlock RandomStream::first_counter(RandomKey key, std::uint32_t generation, std::uint32_t member) {
  TORQUESCOPE_EXPECT(key.run < (1u << 24));
  return {0, member, generation, (static_cast<std::uint32_t>(key.domain) << 24) | key.run};
}

std::array<std::uint32_t, 2> RandomStream::philox_key(RandomKey key) {
  return {static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)};
}

RandomStream::RandomStream(RandomKey key, std::uint32_t generation, std::uint32_t member)
    : key_(philox_key(key)), counter_(first_counter(key, generation, member)) {}

RandomStream::RandomStream(RandomKey key, std::uint32_t generation, std::uint32_t member,
                           std::span<std::uint32_t const> first_blocks)
    : RandomStream(key, generation, member) {
  TORQUESCOPE_EXPECT(first_blocks.size() % 4 == 0);
  first_blocks_ = first_blocks;
}

void RandomStream::next_block() {
  std::size_t const given = std::size_t{4} * counter_[0];
  if (given < first_blocks_.size())
    std::copy_n(first_blocks_.begin() + static_cast<std::ptrdiff_t>(given), 4, block_.begin());
  else
    block_ = philox4x32(counter_, key_);
  ++counter_[0];
  used_ = 0;
}

std::uint64_t RandomStream::bits() {
  if (used_ == 4) next_block();
  std::uint64_t const low = block_[used_];
  std::uint64_t const high = block_[used_ + 1];
  used_ += 2;
  return (high << 32) | low;
}

double RandomStream::uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

double RandomStream::uniform(double low, double high) { return low + uniform() * (high - low); }

std::uint32_t RandomStream::below(std::uint32_t n) {
  TORQUESCOPE_EXPECT(n >= 1);
  return static_cast<std::uint32_t>(((bits() >> 32) * n) >> 32);
}

double RandomStream::normal() {
  // the middle of one of 2^53 cells: never 0 or 1
  double const probability = (static_cast<double>(bits() >> 11) + 0.5) * 0x1.0p-53;
  return normal_quantile(probability);
}

}  // namespace torquescope
