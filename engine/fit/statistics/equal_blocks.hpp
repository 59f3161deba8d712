#pragma once
// Rows in equal stretches of time, one after the other; where they do not divide evenly the stretches differ by a row.
//
// Requires   count > 0
// Threads    free function

#include <Eigen/Core>
#include <vector>

namespace torquescope {

// rows from .. to - 1
struct RowBlock {
  Eigen::Index from = 0, to = 0;
  Eigen::Index size() const { return to - from; }
};

// stretches of rows that cross-validation leaves out in turn (Burman, Chow, Nolan 1994, doi:10.1093/biomet/81.2.351)
inline constexpr Eigen::Index n_folds = 10;

inline std::vector<RowBlock> equal_blocks(Eigen::Index n_rows, Eigen::Index count) {
  std::vector<RowBlock> blocks;
  for (Eigen::Index block = 0; block < count; ++block)
    blocks.push_back({n_rows * block / count, n_rows * (block + 1) / count});
  return blocks;
}

// of n, without the block and `guard` rows on either side of it
inline std::vector<Eigen::Index> rows_outside(Eigen::Index n, RowBlock const& block, Eigen::Index guard) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < n; ++i)
    if (i < block.from - guard || i >= block.to + guard) rows.push_back(i);
  return rows;
}

}  // namespace torquescope
