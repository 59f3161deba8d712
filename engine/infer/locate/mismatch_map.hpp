#pragma once
// The residual of a recording against that of its replicates, along nine axes (METHOD.md, The mismatch map).
//
// Equation   z = (mean residual - replicates' mean) / (replicates' spread * sqrt(1 + 1/M)), per cell; a cell without
//            rows has samples = 0 and NaN. Spectra: amplitudes of residual - replicates' mean, z of the log power
// Shares     energy of the cell means beyond the replicates, over that of the residual; 0 to 1. Position and time: a
//            mean per direction. Spectra: the largest third-octave window. p: empirical, of that share among the
//            replicates
// Regions    map_regions.hpp; repeatable: share of a region's energy that is constant within cells, beyond the
//            replicates
// After      the same cells with the accepted effects in the model; rows beyond the edges go to the end cells
// Requires   M >= 8 replicates; regions from 19 on
// Threads    spreads replicates over `threads`; same bits for any number

#include <vector>

#include "engine/effects/joint_scales.hpp"
#include "engine/infer/locate/mismatch_rows.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

std::vector<MapAxis> mismatch_map(MismatchRows const& rows, JointScales const& scales, int threads);

// fills after_z and after_residual; `after` may have other rows and another number of replicates
void add_after(std::vector<MapAxis>& map, MismatchRows const& after, int threads = 1);

}  // namespace torquescope
