#include "engine/store/fletcher32.hpp"

#include <algorithm>
#include <cstring>

namespace torquescope {
namespace {

constexpr std::size_t lanes = 16;
constexpr std::uint64_t modulus = 65535;
// the most words per lane whose weighted sum fits into 32 bits
constexpr std::size_t most_steps = 360;

struct Sums {
  std::uint64_t s1 = 0, s2 = 0;

  // behind what is summed already: `count` more words with these sums of their own
  void append(std::uint64_t more_s1, std::uint64_t more_s2, std::uint64_t count) {
    s2 = (s2 + s1 * count + more_s2) % modulus;
    s1 = (s1 + more_s1) % modulus;
  }
};

// four pairs of words as they lie in memory, low byte first (an extension of GCC and Clang; on x86-64 an SSE2
// register). Loops over plain arrays were left half scalar by GCC 12 and ran at HDF5's own speed
using FourPairs [[gnu::vector_size(16)]] = std::uint32_t;

struct LaneSums {
  FourPairs even1{}, even2{}, odd1{}, odd2{};

  void add(FourPairs words) {
    even1 += words & 0xffff;
    even2 += even1;
    odd1 += words >> 16;
    odd2 += odd1;
  }
};

// lane j takes words j, j + lanes, ...
void add_steps(Sums& sums, std::byte const* bytes, std::size_t steps) {
  LaneSums first, second;
  for (std::size_t step = 0; step < steps; ++step) {
    FourPairs words[2];
    std::memcpy(words, bytes + step * sizeof(words), sizeof(words));
    first.add(words[0]);
    second.add(words[1]);
  }
  // word i = step * lanes + j has the weight lanes * (steps - step) - j
  std::uint64_t s1 = 0, s2 = 0;
  auto const add_lane = [&](std::uint64_t lane1, std::uint64_t lane2, std::size_t j) {
    s1 += lane1;
    s2 += lanes * lane2 - j * lane1;
  };
  for (std::size_t pair = 0; pair < 4; ++pair) {
    add_lane(first.even1[pair], first.even2[pair], 2 * pair);
    add_lane(first.odd1[pair], first.odd2[pair], 2 * pair + 1);
    add_lane(second.even1[pair], second.even2[pair], 8 + 2 * pair);
    add_lane(second.odd1[pair], second.odd2[pair], 8 + 2 * pair + 1);
  }
  sums.append(s1, s2, steps * lanes);
}

// exchanging the bytes of every word multiplies each sum by 256 modulo 65535
std::uint32_t with_high_byte_first(std::uint64_t sum, bool all_zero) {
  if (all_zero) return 0;
  std::uint64_t const residue = sum * 256 % modulus;
  return static_cast<std::uint32_t>(residue == 0 ? modulus : residue);
}

}  // namespace

std::uint32_t fletcher32(std::span<std::byte const> bytes) {
  constexpr std::size_t bytes_per_step = lanes * sizeof(std::uint16_t);
  Sums sums;
  bool all_zero = true;
  std::size_t done = 0;
  while (bytes.size() - done >= bytes_per_step) {
    std::size_t const steps = std::min(most_steps, (bytes.size() - done) / bytes_per_step);
    if (all_zero) {
      auto const part = bytes.subspan(done, steps * bytes_per_step);
      all_zero = std::all_of(part.begin(), part.end(), [](std::byte byte) { return byte == std::byte{0}; });
    }
    add_steps(sums, bytes.data() + done, steps);
    done += steps * bytes_per_step;
  }
  for (; done < bytes.size(); done += 2) {
    std::uint16_t word = 0;
    std::memcpy(&word, bytes.data() + done, std::min(sizeof(word), bytes.size() - done));
    all_zero = all_zero && word == 0;
    sums.append(word, word, 1);
  }
  return with_high_byte_first(sums.s2, all_zero) << 16 | with_high_byte_first(sums.s1, all_zero);
}

}  // namespace torquescope
