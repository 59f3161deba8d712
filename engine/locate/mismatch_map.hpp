#pragma once
// Where the model is wrong: the recording's residual against its clean twins, along nine axes ("Locate").
//
// Axes       map_axes.hpp, in that order; each always there, a quiet one is evidence
// Cell       mean residual (which reading: shown_reading()), the twins' mean of it, the spread of one twin's, and
//            z = (recording - twins) / (spread sqrt(1 + 1/M)). Without rows: samples = 0, the numbers NaN.
//            Spectrum: `samples` counts waves, the numbers are amplitudes of the residual less the mean of the twins, z
//            is that of the log power
// Share      of the recording's residual energy, at least 0 and at most 1.
//            Means: sum over cells of rows (mean - mean of twins)^2, less the average of the same over the twins.
//            Position and time: with a mean for either direction of motion, else friction that changes with them would
//            average out.
//            Spectrum: the largest over third-octave windows of energy beyond the twins, less the average of the same
//            over the twins. Not the whole spectrum: any mismatch at all has one, and its sum says nothing of this axis
// p          of that share among the twins, empirical
// Regions    map_regions.hpp; at most 5 % of clean recordings show one on a given axis (not: on any of nine). Position
//            and time are read in both ways, so a region there may lie where the shown means are quiet. A spectrum's
//            regions lie above the twins
// time       of a region: its share of the rows; NaN for a spectrum
// energy     of a region: the residual's energy on its rows over that on all rows; spectrum: energy of its waves over
//            it
// repeatable of a region: share of its own energy which is constant within cells and not in the twins, less the average
// of
//            the same over the twins. What varies inside a cell counts as not repeatable. 0 to 1; NaN without energy
// After      the same cells and readings with the effects that were named in the model; rows beyond the edges go to the
//            end cells
// Requires   M >= 8 for a map (from 19 on with regions). Error rates hold as far as twins are like the recording; the
//            frequency row asks most, since it sees the spectrum of their noise
// Cost       12 000 rows, 200 twins: below a second on one core; memory small beside the rows
// Threads    spreads twins over `threads`; same bits for any number
// Source     PHYSICS.md section 1 (signature axes); UX.md section 3 item 3; LESSONS item 7

#include <vector>

#include "engine/effects/joint_scales.hpp"
#include "engine/twin/mismatch_rows.hpp"
#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

std::vector<MapAxis> mismatch_map(MismatchRows const& rows, JointScales const& scales, int threads);

// fills after_z and after_residual; `after` may have other rows and another number of twins
void add_after(std::vector<MapAxis>& map, MismatchRows const& after, int threads = 1);

}  // namespace torquescope
