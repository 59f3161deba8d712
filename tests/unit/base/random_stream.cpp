#include "engine/base/random_stream.hpp"

#include <Random123/philox.h>
#undef philox4x32  // a macro of theirs; the oracle is used through its class
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace torquescope {
namespace random_stream_test {

TEST(Philox, EqualsRandom123BitForBit) {
  r123::Philox4x32 oracle;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    PhiloxBlock const counter{i * 2654435761u, i, ~i, i * i};
    std::array<std::uint32_t, 2> const key{i * 40503u + 7u, i ^ 0xdeadbeefu};
    auto const expected = oracle({{counter[0], counter[1], counter[2], counter[3]}}, {{key[0], key[1]}});
    auto const ours = philox4x32(counter, key);
    for (std::size_t w = 0; w < 4; ++w) ASSERT_EQ(ours[w], expected[w]);
  }
}

TEST(RandomStream, IsAddressedNotDrawnInTurn) {
  RandomKey const key{42, 3};
  RandomStream first(key, 5, 7);
  double const a = first.uniform(), b = first.uniform(), c = first.uniform();
  RandomStream other(key, 5, 8);
  other.uniform();
  RandomStream again(key, 5, 7);
  EXPECT_EQ(a, again.uniform());
  EXPECT_EQ(b, again.uniform());
  EXPECT_EQ(c, again.uniform());
}

TEST(RandomStream, SkipsDrawsAsIfTheyHadBeenMade) {
  RandomKey const key{42, 3};
  for (std::size_t before : {0u, 1u, 2u, 3u}) {
    for (std::size_t skipped : {0u, 1u, 2u, 5u, 8u}) {
      RandomStream drawing(key, 5, 7), skipping(key, 5, 7);
      for (std::size_t draw = 0; draw < before + skipped; ++draw) drawing.bits();
      for (std::size_t draw = 0; draw < before; ++draw) skipping.bits();
      skipping.skip(skipped);
      for (int draw = 0; draw < 5; ++draw) ASSERT_EQ(skipping.bits(), drawing.bits()) << before << ", " << skipped;
    }
  }
}

TEST(RandomStream, DiffersInEveryPartOfItsAddress) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed : {1ull, 1ull << 40})
    for (std::uint32_t run : {0u, 1u})
      for (auto domain : {RandomDomain::optimiser, RandomDomain::simulation})
        for (std::uint32_t generation : {0u, 1u})
          for (std::uint32_t member : {0u, 1u})
            seen.insert(RandomStream({seed, run, domain}, generation, member).bits());
  EXPECT_EQ(seen.size(), 32u);
}

TEST(RandomStream, UniformAndNormalHaveTheirMoments) {
  int const n = 200000;
  double sum = 0, square = 0, normal_sum = 0, normal_square = 0, fourth = 0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
    RandomStream stream({1, 0, RandomDomain::test}, 0, i);
    double const u = stream.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    square += u * u;
    double const z = stream.normal();
    normal_sum += z;
    normal_square += z * z;
    fourth += z * z * z * z;
  }
  // five standard errors of each mean
  EXPECT_NEAR(sum / n, 0.5, 5 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(square / n, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / n));
  EXPECT_NEAR(normal_sum / n, 0.0, 5 / std::sqrt(n));
  EXPECT_NEAR(normal_square / n, 1.0, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth / n, 3.0, 5 * std::sqrt(96.0 / n));
}

TEST(RandomStream, BelowIsUniform) {
  int counts[7] = {};
  for (std::uint32_t i = 0; i < 70000; ++i) ++counts[RandomStream({9, 1, RandomDomain::test}, 1, i).below(7)];
  for (int count : counts) EXPECT_NEAR(count, 10000, 5 * std::sqrt(10000.0 * 6 / 7));
}

}  // namespace random_stream_test
}  // namespace torquescope
