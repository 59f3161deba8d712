#pragma once
// The last look at several accepted effects: an early one may have stood for two.
//
// Backward   an effect whose own share, beside all others, is below 0.2 % of the whole is removed
// Swap       an effect is replaced by another of its families that explains 3 % more beside all others, when the
//            replicates with the other leave less
// Replicates made anew after every change
// Threads    as the stages
// Source     METHOD.md, Other lines

#include "engine/search/forward_selection.hpp"

namespace torquescope {

// selection.accepted belongs to the effects of the final model, in their order, before and after
void revise_selection(StageSetting const& setting, SelectionOptions const& options, Selection& selection);

}  // namespace torquescope
