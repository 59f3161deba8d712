#pragma once
// Every candidate effect at every point of its shape grid, on the recording and on each of its replicates.
//
// Equation   c = Q'(residual - replicates' mean), Q: orthonormal columns of the effect beside the model;
//            T = c' S^-1 c with S the replicates' covariance of c, largest over the grid; a single parameter that must
//            not be negative counts only with that sign
// Null       the same of each replicate against all others (leave-one-out), largest over the same grid
// Gain       energy of the mismatch explained with allowed signs, less that of noise: candidates are ranked by it
// Units      gain in (N m)^2 or N^2, summed over rows
// Threads    spreads grid points over `threads`; same bits for any number
// Source     METHOD.md, The null distribution

#include <vector>

#include "engine/search/candidate_columns.hpp"
#include "engine/search/shape_grid.hpp"

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

std::vector<EffectScan> scan_candidates(CandidateColumns const& columns, std::vector<Effect const*> const& effects,
                                        int threads);

}  // namespace torquescope
