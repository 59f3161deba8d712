#pragma once
// The forward search, followed to its end; and once more from where something else was nearly as good, when what was
// taken leaves something.
//
// Why        two laws may explain the same at one step and not at the next: friction that waves along the travel and
//            torque ripple are one where the torque is friction, but only the right one's second wave fits as well
// When       the end leaves something, even if less than chance may: two models compared with each other show what
//            either alone does not; and a round could have taken an effect of another family. At most two of them, the
//            first round's first. Within a family backward_selection.hpp swaps
// Wins       a line that leaves less than half of what the first one leaves, with as many effects at most, when the
//            difference is beyond five standard deviations of a single parameter
// Threads    as the stages
// Source     beam search, Lowerre 1976, of width two, and only in doubt

#include "engine/search/effect_search.hpp"

namespace torquescope {

// search: at its beginning
EffectSearch best_line(EffectSearch search);

}  // namespace torquescope
