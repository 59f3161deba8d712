#pragma once
// How much of the residuals a wave of one frequency, or of one order of the position, explains: least squares at every
// wave of a fine grid, on rows with gaps.
//
// Equation   energy(f) = max over a, b of ||x||^2 - ||x - a cos(2 pi f s) - b sin(2 pi f s)||^2, s: time or position
// x          recording: residual - replicates' mean; replicate: the same times sqrt((M + 1) / (M - 1)), so that a clean
//            recording and a replicate have the same expected energy
// Grid       kept samples in time (exact); position: eighths of the shortest wave, which costs it at most 5 % of its
//            energy. Waves are half to a quarter of 1 / span apart: none falls between two
// Method     one FFT for two columns, one for the gaps (sums of cos^2, sin^2, sin cos): Lomb-Scargle without its phase
// Units      Hz and s; 1/rad and rad (order k is cos(k q)), 1/m and m. Memory: bands x (1 + M), some grids per thread
// Threads    spreads columns over `threads`; same bits for any number
// Source     Lomb 1976, doi:10.1007/BF00648343; Press, Rybicki 1989, doi:10.1086/167197

#include <Eigen/Core>
#include <vector>

#include "engine/infer/locate/mismatch_rows.hpp"

namespace torquescope {

struct WaveGrid {
  std::vector<Eigen::Index> point{};  // of each row
  Eigen::Index points = 0;            // the last one used, plus one
  Eigen::Index length = 0;            // of the FFT, a power of two
  double spacing = 0.0;               // between neighbouring waves, in the unit of the axis
  double highest = 0.0;               // end of the range, in the unit of the axis
  Eigen::Index first = 1, last = 0;   // waves in the range: wave j is at j * spacing; none: last < first

  // waves that belong to one degree of freedom: energies of neighbours overlap this often
  double overlap() const { return static_cast<double>(length) / static_cast<double>(points); }
};

// from one wave per recording to `highest_hz` or half the rate
WaveGrid time_waves(MismatchRows const& rows, double highest_hz);
// from one wave per range of the rows to `highest` (1/rad, 1/m), or one wave for two rows
WaveGrid position_waves(MismatchRows const& rows, double highest);

// waves first .. last; empty when last < first
struct WaveBand {
  Eigen::Index first = 0, last = -1;
  Eigen::Index waves() const { return last - first + 1; }
};

// bands x (1 + M), the recording first: sum of the waves' energies over overlap()
Eigen::MatrixXd band_energies(MismatchRows const& rows, WaveGrid const& grid, std::vector<WaveBand> const& bands,
                              int threads);

}  // namespace torquescope
