#include "engine/base/digest.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/digest_batch.hpp"
#include "engine/base/digest_pair.hpp"

namespace torquescope {
namespace digest_test {

TEST(Digest, IsSha256OfTheStandard) {
  // FIPS 180-4, examples
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Digest, OfPartsIsThatOfTheWhole) {
  Digest parts;
  parts.bytes("a", 1).bytes("", 0).bytes("bc", 2);
  EXPECT_EQ(parts.hex(), sha256_hex("abc"));
}

TEST(Digest, OfTwoIsThatOfEach) {
  std::vector<std::byte> bytes(1000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * i % 251);
  std::span<std::byte const> const all(bytes);
  // ends on both sides of a block of 64 and of the eight bytes for the length
  std::size_t const sizes[] = {0, 1, 54, 55, 56, 63, 64, 65, 119, 120, 128, 900};
  for (std::size_t a : sizes)
    for (std::size_t b : sizes) {
      auto const first = all.first(a), second = all.last(b);
      auto const both = sha256_of_two(first, second);
      EXPECT_EQ(both.first, Digest().bytes(first.data(), a).raw()) << a << " and " << b;
      EXPECT_EQ(both.second, Digest().bytes(second.data(), b).raw()) << a << " and " << b;
    }
}

TEST(Digest, OfManyIsThatOfEach) {
  for (std::size_t size : {0, 1, 55, 56, 63, 64, 119, 120, 128, 1000})
    for (std::size_t count : {0, 1, 2, 9, 10, 15, 16, 17, 27, 43}) {
      std::vector<std::vector<std::byte>> texts(count, std::vector<std::byte>(size + 1));
      std::vector<std::byte const*> places;
      for (std::size_t t = 0; t < count; ++t) {
        for (std::size_t i = 0; i < size; ++i) texts[t][i] = static_cast<std::byte>((i * i + 31 * t) % 251);
        places.push_back(texts[t].data());
      }
      std::vector<Sha256> digests(count);
      sha256_of_each(places, size, digests.data());
      for (std::size_t t = 0; t < count; ++t)
        ASSERT_EQ(digests[t], Digest().bytes(places[t], size).raw())
            << t << " of " << count << ", " << size << " bytes";
    }
}

TEST(Digest, OfBlocksIsThatOfTheDigestsOfEach) {
  constexpr std::size_t block = long_digest_block_bytes;
  std::vector<std::byte> bytes(3 * block + 1000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>((i * i + i / 77) % 251);
  for (std::size_t size : {std::size_t{0}, std::size_t{1}, block, block + 1, 2 * block, 3 * block, bytes.size()}) {
    Digest expected;
    for (std::size_t first = 0; first < size; first += block) {
      auto const one = Digest().bytes(bytes.data() + first, std::min(block, size - first)).raw();
      expected.bytes(one.data(), one.size());
    }
    EXPECT_EQ(sha256_by_blocks(std::span(bytes).first(size)), expected.raw()) << size;
  }
}

TEST(Digest, TellsWhereATextEnds) {
  EXPECT_NE(Digest().text("ab").text("c").hex(), Digest().text("a").text("bc").hex());
  std::vector<double> const numbers{1.0, -0.0};
  EXPECT_EQ(Digest().numbers(numbers).raw(), Digest().bytes(numbers.data(), 16).raw());
}

}  // namespace digest_test
}  // namespace torquescope
