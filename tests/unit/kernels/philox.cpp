// Bulk Philox is Random123's, bit for bit, on every instruction set.
#include "kernels/philox.hpp"

#include <Random123/philox.h>
#undef philox4x32  // a macro of theirs; the oracle is used through its class
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::kernels {
namespace philox_test {

class Philox : public EveryInstructionSet {};

INSTANTIATE_TEST_SUITE_P(Target, Philox, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

void expect_random123(PhiloxStreams const& streams, std::size_t n_streams, std::size_t first_block,
                      std::size_t n_blocks) {
  std::uint32_t const guard = 0xABCDEF01u;
  std::vector<std::uint32_t> blocks(n_streams * n_blocks * 4 + 8, guard);
  philox_blocks(streams, n_streams, first_block, n_blocks, blocks.data());
  r123::Philox4x32 oracle;
  for (std::size_t i = 0; i < n_streams; ++i) {
    for (std::size_t b = 0; b < n_blocks; ++b) {
      auto const expected =
          oracle({{static_cast<std::uint32_t>(first_block + b), streams.first_word_1 + static_cast<std::uint32_t>(i),
                   streams.word_2, streams.word_3}},
                 {{streams.key[0], streams.key[1]}});
      for (std::size_t w = 0; w < 4; ++w)
        ASSERT_EQ(blocks[(i * n_blocks + b) * 4 + w], expected[w]) << "stream " << i << ", block " << b;
    }
  }
  for (std::size_t i = n_streams * n_blocks * 4; i < blocks.size(); ++i) ASSERT_EQ(blocks[i], guard);
}

TEST_P(Philox, EqualsRandom123BitForBit) {
  std::mt19937 random(5);
  for (std::size_t n_streams : {0, 1, 3, 8, 30, 31})
    for (std::size_t n_blocks : {1, 2, 5, 8, 9})
      for (int i = 0; i < 20; ++i) {
        std::uint32_t const a = random(), b = random(), c = random(), d = random(), e = random(), f = random();
        expect_random123({{a, b}, c >> 1, d, e}, n_streams, i % 2 == 0 ? 0 : f >> 1, n_blocks);
      }
}

TEST_P(Philox, TakesTheLargestWords) {
  std::uint32_t const most = 0xFFFFFFFFu;
  expect_random123({{most, most}, most - 6, most, most}, 7, most - 2, 3);
}

}  // namespace philox_test
}  // namespace torquescope::kernels
