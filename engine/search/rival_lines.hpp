#pragma once
// The forward search to its end, and once more from where another effect was nearly as good.
//
// Why        two laws may explain the same at one step and not at the next, for example friction that waves along the
//            travel and torque ripple
// When       the end leaves something, and a round could have accepted an effect of another family. At most two such
//            rounds, the first one first. Within a family backward_selection.hpp swaps
// Wins       a line that leaves less than half, with at most as many effects, by five standard deviations of a
//            parameter
// Threads    as the stages
// Source     beam search of width two, Lowerre 1976, The HARPY speech recognition system (thesis)

#include "engine/search/effect_search.hpp"

namespace torquescope {

// search: at its beginning
EffectSearch best_line(EffectSearch search);

}  // namespace torquescope
