#include "engine/base/digest.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace torquescope {
namespace {

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

TEST(Digest, TellsWhereATextEnds) {
  EXPECT_NE(Digest().text("ab").text("c").hex(), Digest().text("a").text("bc").hex());
  std::vector<double> const numbers{1.0, -0.0};
  EXPECT_EQ(Digest().numbers(numbers).raw(), Digest().bytes(numbers.data(), 16).raw());
}

}  // namespace
}  // namespace torquescope
