#pragma once
// The k-th smallest of many numbers, without a copy of them: they are asked for again a few times instead.
//
// Equation   values sorted upwards, the one at index k: the same number as std::nth_element would put there
// Method     the bits of a non-negative double order like the number: count by 11 bits, go on in the bin that holds the
//            k-th, until what is left fits into `most_kept` numbers
// Memory     most_kept doubles and 2048 counters, whatever n
// Requires   every value >= 0 (or +infinity); k < number of values; for_each gives the same values each time
// Threads    free functions

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "engine/base/contract.hpp"

namespace torquescope {

inline constexpr std::size_t most_kept_values = std::size_t{1} << 15;

// for_each(visit) calls visit(double) for every value
template <class ForEach>
double kth_smallest(ForEach const& for_each, std::size_t k, std::size_t most_kept = most_kept_values) {
  constexpr int digit_bits = 11;
  std::uint64_t known = 0, known_mask = 0;  // leading bits of the k-th
  auto const is_left = [&](double value) { return (std::bit_cast<std::uint64_t>(value) & known_mask) == known; };
  std::size_t left = 0;
  for_each([&](double) { ++left; });
  TORQUESCOPE_EXPECT(k < left);

  // 64 = 9 + 5 * 11 bits: the first digit is a short one
  for (int shift = 5 * digit_bits; left > most_kept && shift >= 0; shift -= digit_bits) {
    std::array<std::size_t, std::size_t{1} << digit_bits> count{};
    auto const digit_of = [&](std::uint64_t bits) { return (bits >> shift) & (count.size() - 1); };
    for_each([&](double value) {
      if (is_left(value)) ++count[digit_of(std::bit_cast<std::uint64_t>(value))];
    });
    std::uint64_t digit = 0;
    while (k >= count[digit]) k -= count[digit++];
    left = count[digit];
    known |= digit << shift;
    known_mask = ~std::uint64_t{0} << shift;
  }
  if (known_mask == ~std::uint64_t{0}) return std::bit_cast<double>(known);  // many equal numbers

  std::vector<double> kept;
  kept.reserve(left);
  for_each([&](double value) {
    if (is_left(value)) kept.push_back(value);
  });
  auto const place = kept.begin() + static_cast<std::ptrdiff_t>(k);
  std::nth_element(kept.begin(), place, kept.end());
  return *place;
}

}  // namespace torquescope
