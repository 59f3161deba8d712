#pragma once
// Where on an axis the recording differs from its clean twins: runs of neighbouring cells, with one error rate per
// axis.
//
// z          of the recording among all twins, of each twin among all others (twin_null.hpp)
// Seed       a cell whose |z| is beyond the largest |z| that 95 % of the twins have anywhere on the axis: at most 5 %
//            of clean recordings show any region on this axis. Fewer than 19 twins cannot carry a 5 % claim: no regions
// Growth     from a seed to neighbours of the same sign whose |z| is beyond what 95 % of all single cells of the twins
//            have
// Readings   one axis may be read in several ways (the residual itself, the residual along the motion): the largest |z|
//            is taken over all of them, and their runs are merged where they overlap
// Empty      a cell without rows has z = NaN and ends a run, unless it has no width (tied quantiles)
// Requires   M >= 3
// Threads    free functions

#include <Eigen/Core>
#include <span>
#include <vector>

namespace torquescope {

struct CellScores {
  Eigen::VectorXd recording;  // z per cell; NaN: empty
  Eigen::MatrixXd twins;      // cells x M
};

// values: cells x (1 + M), the recording first; a row of NaN is an empty cell
CellScores score_cells(Eigen::MatrixXd const& values);

struct CellRun {
  int first = 0, last = 0;  // both belong to it
};

enum class Tail { upper, both };  // a spectrum below its twins' is no missing physics

// `edges`: one more than cells; runs ascend and do not overlap
std::vector<CellRun> unusual_runs(std::span<CellScores const> readings, std::span<double const> edges, Tail tail);

}  // namespace torquescope
