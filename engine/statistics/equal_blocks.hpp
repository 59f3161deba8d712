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

inline std::vector<RowBlock> equal_blocks(Eigen::Index n_rows, Eigen::Index count) {
  std::vector<RowBlock> blocks;
  for (Eigen::Index block = 0; block < count; ++block)
    blocks.push_back({n_rows * block / count, n_rows * (block + 1) / count});
  return blocks;
}

}  // namespace torquescope
