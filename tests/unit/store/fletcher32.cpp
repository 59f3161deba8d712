#include "engine/store/fletcher32.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace torquescope {
namespace fletcher32_test {

// word by word, as it is defined
std::uint32_t plain(std::span<std::byte const> bytes) {
  std::uint64_t s1 = 0, s2 = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    s1 += std::to_integer<std::uint64_t>(bytes[i]) << 8;
    if (i + 1 < bytes.size()) s1 += std::to_integer<std::uint64_t>(bytes[i + 1]);
    s2 += s1;
  }
  // HDF5 folds carries rather than divides: only a sum of 0 stays 0
  auto const folded = [](std::uint64_t sum) {
    return static_cast<std::uint32_t>(sum == 0 ? 0 : (sum - 1) % 65535 + 1);
  };
  return folded(s2) << 16 | folded(s1);
}

std::vector<std::byte> bytes(std::size_t count, std::uint32_t state) {
  std::vector<std::byte> all(count);
  for (std::byte& byte : all) {
    state = state * 1664525U + 1013904223U;
    byte = static_cast<std::byte>(state >> 24);
  }
  return all;
}

TEST(Fletcher32, IsItsDefinitionForEverySize) {
  auto const all = bytes(30000, 1);
  for (std::size_t size = 0; size < 200; ++size)
    EXPECT_EQ(fletcher32({all.data(), size}), plain({all.data(), size})) << size;
  for (std::size_t size = 200; size <= all.size(); size += 149)
    EXPECT_EQ(fletcher32({all.data(), size}), plain({all.data(), size})) << size;
}

TEST(Fletcher32, DoesNotOverflowNorTakeOnesForZeros) {
  for (std::size_t size : {2U, 31U, 32U, 11520U, 11552U, 1048576U}) {
    std::vector<std::byte> const ones(size, std::byte{255}), zeros(size, std::byte{0});
    EXPECT_EQ(fletcher32(ones), plain(ones)) << size;
    EXPECT_EQ(fletcher32(zeros), 0U) << size;
    auto last = zeros;
    last.back() = std::byte{1};
    EXPECT_EQ(fletcher32(last), plain(last)) << size;
  }
}

}  // namespace fletcher32_test
}  // namespace torquescope
