#pragma once
// A second look at the recording with its reversals: does friction build up over a distance after each of them, or
// nested loop by nested loop, where the search (forward_selection.hpp) masked them?
//
// When       nothing that was named remembers reversals itself, and what was named leaves no structure of its own
// Rows       all but rests; weights and levels of noise are those of the masked rows, where no law of sticking matters
// Candidate  buildup_trial.hpp: along the common motion, then along the recording's own. How abruptly friction changes
//            its side with the speed is not known, and not asked. Friction that builds up changes its side late: it
//            remembers
// Gate       omnibus z above 4 and mismatch above 0.25 % of the torque's rms, as in the search; first with few twins
// Named      when twins with it lose more than half of all that is missing on these rows. Against the baseline twins
//            must still confirm a third of its gain. Where neither is named though the gate was passed, the selection
//            says so (differs_at_reversals). The two are relatives: whether the other fits as well is asked as for
//            every name (equivalent_effects.hpp)
// Then       rows at reversals stay in: baseline and final model are fitted, shown and checked on unseen data with
//            them, and what was named before must still be of use
// Threads    as the stages
// Source     LESSONS items 3 and 4 of our own prototype; Swevers, Al-Bender, Ganseman, Prajogo 2000

#include "engine/search/forward_selection.hpp"

namespace torquescope {

// true: selection is that with the effect, on rows with reversals (Selection::keeps_reversals)
bool look_at_reversals(StageSetting const& setting, SelectionOptions const& options, Selection& selection,
                       StageSink const& progress);

}  // namespace torquescope
