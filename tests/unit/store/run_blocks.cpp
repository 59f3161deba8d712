#include "engine/store/run_blocks.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>

namespace torquescope {
namespace run_blocks_test {

// seven runs of two numbers, three in a block; what came out, by block
struct Collected {
  std::map<std::size_t, std::vector<double>> blocks;
  RunBlocks::Emit emit = [this](std::size_t first, std::size_t count, std::span<std::byte const> bytes) {
    EXPECT_EQ(bytes.size(), count * 2 * sizeof(double));
    auto const* values = reinterpret_cast<double const*>(bytes.data());
    EXPECT_TRUE(blocks.emplace(first, std::vector<double>(values, values + 2 * count)).second) << "twice: " << first;
  };
};

void put(RunBlocks& runs, std::size_t run, Collected& collected) {
  double const values[] = {static_cast<double>(run), static_cast<double>(run) + 0.5};
  runs.put(run, std::as_bytes(std::span(values)), collected.emit);
}

TEST(RunBlocks, GivesWholeBlocksAsSoonAsTheyAreWhole) {
  for (auto const& order : std::vector<std::vector<std::size_t>>{{0, 1, 2, 3, 4, 5, 6}, {6, 0, 3, 1, 5, 2, 4}}) {
    RunBlocks runs(7, 16, 3, 0);
    Collected collected;
    std::set<std::size_t> given;
    for (std::size_t run : order) {
      put(runs, run, collected);
      given.insert(run);
      for (std::size_t first : {0U, 3U, 6U}) {
        bool whole = true;
        for (std::size_t i = first; i < std::min<std::size_t>(first + 3, 7); ++i) whole = whole && given.contains(i);
        EXPECT_EQ(collected.blocks.contains(first), whole);
      }
    }
    EXPECT_EQ(collected.blocks[3], (std::vector<double>{3, 3.5, 4, 4.5, 5, 5.5}));
    EXPECT_EQ(collected.blocks[6], (std::vector<double>{6, 6.5}));
    runs.put_rest(collected.emit);
    EXPECT_EQ(collected.blocks.size(), 3U);
  }
}

TEST(RunBlocks, GivesBlocksOfNeighboursThatComeTogetherWithoutACopy) {
  std::vector<double> const values{2, 2.5, 3, 3.5, 4, 4.5, 5, 5.5, 6, 6.5};
  RunBlocks runs(7, 16, 3, 0);
  std::vector<std::size_t> in_place;
  Collected collected;
  runs.put(2, std::as_bytes(std::span(values)), [&](std::size_t first, std::size_t count, auto block) {
    if (block.data() == std::as_bytes(std::span(values)).data() + (first - 2) * 16) in_place.push_back(first);
    collected.emit(first, count, block);
  });
  EXPECT_EQ(in_place, (std::vector<std::size_t>{3, 6}));
  put(runs, 0, collected);
  put(runs, 1, collected);
  EXPECT_EQ(collected.blocks[0], (std::vector<double>{0, 0.5, 1, 1.5, 2, 2.5}));
  EXPECT_EQ(collected.blocks[3], (std::vector<double>{3, 3.5, 4, 4.5, 5, 5.5}));
}

TEST(RunBlocks, FillsWhatNeverCame) {
  RunBlocks runs(7, 16, 3, std::bit_cast<std::uint64_t>(std::nan("")));
  Collected collected;
  put(runs, 4, collected);
  runs.put_rest(collected.emit);
  ASSERT_EQ(collected.blocks.size(), 3U);
  EXPECT_EQ(collected.blocks[3][2], 4.0);
  EXPECT_EQ(collected.blocks[3][3], 4.5);
  for (double value : {collected.blocks[0][0], collected.blocks[3][0], collected.blocks[3][4], collected.blocks[6][1]})
    EXPECT_TRUE(std::isnan(value));
}

}  // namespace run_blocks_test
}  // namespace torquescope
