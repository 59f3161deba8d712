#pragma once
// One effect over its shape grid: the best point and how far its gain is beyond chance.
//
// Units      gain in (N m)^2 or N^2, summed over rows
// Threads    plain record
// Source     engine/infer/moving_rows/THEORY.md, Null distribution

#include <vector>

#include "engine/infer/search/candidate_columns.hpp"
#include "engine/infer/search/shape_grid.hpp"

namespace torquescope {

struct EffectScan {
  Effect const* effect = nullptr;
  bool is_testable = false;  // false: the model explains its columns already, on this motion
  double z = 0.0;            // square root of the largest T
  double chance_z = 0.0;     // 95 % of the twins stay below
  double p = 1.0;            // from the twins' largest T
  bool p_is_bound = false;   // no twin came near: p is the smallest that this many twins can give
  double gain = 0.0;         // largest over the grid
  std::size_t best_point = 0;
  std::vector<double> shape{};   // there
  Eigen::VectorXd parameters{};  // linear ones there
  ShapeGrid grid{};
};

}  // namespace torquescope
