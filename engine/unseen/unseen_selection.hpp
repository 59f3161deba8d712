#pragma once
// Removes an accepted effect beside others that validation recordings speak against; the others stay.
//
// Equation   e: what the effect changes in the prediction, the other terms refitted without it; gain / |e|^2 is 1 for
//            the joint's law and -1 for none, but for noise
// Rule       removed when it makes the prediction worse, moves a tenth of the residual's energy, and does worse than in
//            replicates that have it; unless the rest is then unexplained. No kind of law is spared; the last effect is
//            judged by held_out_judgement.hpp
// Threads    as the stages
// Source     METHOD.md, Validation recordings

#include <span>

#include "engine/search/abstention.hpp"
#include "engine/search/forward_selection.hpp"
#include "engine/unseen/unseen_record.hpp"

namespace torquescope {

// remainder: of the selection, before and after
// Errors     as predict_unseen
void drop_spoilers(StageSetting const& setting, std::span<Recording const> unseen, Selection& selection,
                   Remainder& remainder);

}  // namespace torquescope
