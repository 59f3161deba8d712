#pragma once
// Where on an axis the recording differs from its replicates: runs of neighbouring cells, with one error rate per axis.
//
// z          of the recording among all replicates, of each replicate among all others (replicate_null.hpp)
// Seed       a cell whose |z| is beyond the largest |z| that 95 % of the replicates have anywhere on the axis: at most
//            5 % of clean recordings show a region on this axis. Fewer than 19 replicates: no regions
// Growth     to neighbours of the same sign whose |z| is beyond 95 % of all single cells of the replicates
// Readings   an axis may be read in several ways (the residual, the residual along the motion): the largest |z| of all
//            readings counts, and runs are merged where they overlap
// Empty      a cell without rows has z = NaN and ends a run, unless it has no width (tied quantiles)
// Requires   M >= 3
// Threads    free functions

#include <Eigen/Core>
#include <span>
#include <vector>

namespace torquescope {

struct CellScores {
  Eigen::VectorXd recording;   // z per cell; NaN: empty
  Eigen::MatrixXd replicates;  // cells x M
};

// values: cells x (1 + M), the recording first; a row of NaN is an empty cell
CellScores score_cells(Eigen::MatrixXd const& values);

struct CellRun {
  int first = 0, last = 0;  // both belong to it
};

enum class Tail { upper, both };  // a spectrum below its replicates' is no missing physics

// `edges`: one more than cells; runs ascend and do not overlap
std::vector<CellRun> unusual_runs(std::span<CellScores const> readings, std::span<double const> edges, Tail tail);

}  // namespace torquescope
