#include "engine/base/random_stream.hpp"

#include <cmath>
#include <cstddef>

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

void RandomStream::compute_block() {
  counter_[0] = static_cast<std::uint32_t>(next_word_ / 4);
  block_ = philox4x32(counter_, key_);
}

std::uint64_t RandomStream::bits() {
  std::size_t const place = next_word_ % 4;
  if (place == 0) compute_block();
  next_word_ += 2;
  return (std::uint64_t{block_[place + 1]} << 32) | block_[place];
}

void RandomStream::skip(std::size_t n_draws) {
  next_word_ += 2 * n_draws;
  if (next_word_ % 4 != 0) compute_block();
}

double RandomStream::normal() { return normal_quantile(probability(bits())); }

}  // namespace torquescope
