#include "engine/store/chunking.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace torquescope {
namespace chunking_test {

using Shape = std::vector<std::size_t>;

TEST(ChunkOfRuns, IsOneRunOfUsualSize) {
  // 101 generations of 30 members with 4 parameters: 97 kB
  EXPECT_EQ(chunk_of_runs({30, 101, 30, 4}, 8), (Shape{1, 101, 30, 4}));
}

TEST(ChunkOfRuns, HoldsSeveralSmallRunsButNoMoreThanThereAre) {
  EXPECT_EQ(chunk_of_runs({10000, 101}, 8), (Shape{81, 101}));
  EXPECT_EQ(chunk_of_runs({30}, 8), (Shape{30}));
}

TEST(ChunkOfRuns, CutsALargeRunIntoEqualPartsOfAtMostOneMebibyte) {
  // 101 x 100 x 60 doubles are 4.8 MB: 5 parts of 21 generations waste 4 rows; 101 is prime, no equal parts waste none
  EXPECT_EQ(chunk_of_runs({7, 101, 100, 60}, 8), (Shape{1, 21, 100, 60}));
}

TEST(ChunkOfArray, NeverExceedsOneMebibyteNorWastesMoreThanItsParts) {
  for (std::size_t rows : {1U, 2U, 131072U, 131073U, 1000003U})
    for (std::size_t columns : {1U, 7U, 1000U, 200000U}) {
      Shape const chunk = chunk_of_array({rows, columns}, 8);
      EXPECT_LE(chunk[0] * chunk[1] * 8, std::size_t{1} << 20);
      std::size_t const row_parts = (rows + chunk[0] - 1) / chunk[0];
      std::size_t const column_parts = (columns + chunk[1] - 1) / chunk[1];
      EXPECT_LT(row_parts * chunk[0] - rows, row_parts);
      EXPECT_LT(column_parts * chunk[1] - columns, column_parts);
    }
}

TEST(ChunkOfArray, IsTheWholeArrayWhenItIsSmall) { EXPECT_EQ(chunk_of_array({1000, 4}, 8), (Shape{1000, 4})); }

}  // namespace chunking_test
}  // namespace torquescope
