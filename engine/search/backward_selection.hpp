#pragma once
// The last look at several effects that were named one after the other: an early name may have stood for two.
//
// Backward   an effect whose own share, beside all others, is below 0.2 % of the whole is taken out again
// Swap       an effect is replaced by another of its families that explains 3 % more beside all others, when the twins
//            with the other leave less
// Twins      made anew after every change
// Threads    as the stages
// Source     LESSONS item 15 of our own prototype

#include "engine/search/forward_selection.hpp"

namespace torquescope {

// selection.accepted belongs to the effects of the final model, in their order, before and after
void revise_selection(StageSetting const& setting, SelectionOptions const& options, Selection& selection);

}  // namespace torquescope
