#pragma once
// A second look at the recording with its reversals: does friction build up over a distance after each of them, or nested
// loop by nested loop, where the search (forward_selection.hpp) masked them?
//
// When       nothing that was named remembers reversals itself, and what was named leaves no structure of its own
// Rows       all but rests; weights and levels of noise are those of the masked rows, where no law of sticking matters
// Nuisance   sign(dq) smeared over a speed, at five speeds from 1/2000 to 1/25 of the peak: how abruptly friction changes its
//            side with the speed is not known, and not asked. Friction that builds up changes its side late: it remembers
// Gate       omnibus z above 4 and mismatch above 0.25 % of the torque's rms, as in the search; first with few twins
// Named      the one of the two that explains more, when no other effect explains more than it, q is at the level, it takes more
//            than a quarter of what is left beside the nuisance, helps on other blocks, and with it twins lose more than half
//            of all that is missing on these rows. Against the baseline twins must still confirm a third of its gain.
//            The two are relatives: whether the other fits as well is asked as for every name (equivalent_effects.hpp)
// Then       rows at reversals stay in: baseline and final model are fitted, shown and checked on unseen data with them, and what
//            was named before must still be of use
// Threads    as the stages
// Source     LESSONS items 3 and 4 of our own prototype; Swevers, Al-Bender, Ganseman, Prajogo 2000

#include "engine/diagnose/forward_selection.hpp"

namespace torquescope {

// true: selection is that with the effect, on rows with reversals (Selection::keeps_reversals)
bool look_at_reversals(StageSetting const& setting, SelectionOptions const& options, Selection& selection,
                       StageSink const& progress);

}  // namespace torquescope
