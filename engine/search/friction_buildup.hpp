#pragma once
// Whether friction builds up over a distance after reversals, on rows that the search had masked.
//
// When       no accepted effect remembers reversals, and what was accepted leaves no structure of its own
// Rows       all but rests; weights and noise levels are those of the masked rows
// Candidate  buildup_trial.hpp: along the noise-free motion, then along the recorded one
// Accepted   gates as in the search; replicates with it lose more than half of what is missing on these rows, and
//            against the baseline a third of its gain. When the gate passed and nothing is accepted:
//            differs_at_reversals
// Then       rows at reversals stay in, for fit, map and validation; earlier effects must still be of use
// Threads    as the stages
// Source     METHOD.md, Friction that builds up after reversals; Swevers, Al-Bender, Ganseman, Prajogo 2000,
//            doi:10.1109/9.847103

#include "engine/search/forward_selection.hpp"

namespace torquescope {

// true: selection is that with the effect, on rows with reversals (Selection::keeps_reversals)
bool look_at_reversals(StageSetting const& setting, SelectionOptions const& options, Selection& selection,
                       StageSink const& progress);

}  // namespace torquescope
