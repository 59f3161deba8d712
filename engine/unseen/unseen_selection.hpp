#pragma once
// A name beside others that unseen recordings speak against: it goes, and the others stay.
//
// Equation   e: what the prediction of an unseen recording is moved by the effect, the other terms fitted again without
//            it. A law that is the joint's takes |e|^2 from the residual's energy, one that is none adds as much: gain
//            / |e|^2 is 1 or -1 but for noise
// Rule       it goes when it makes the prediction worse, where it moves a tenth of the residual's energy (of a thousand
//            rows, of which a filter leaves 250, a right law would then fall below 0 in one case of a hundred), and
//            makes it worse than it does in twins that have it, unless the rest is then unexplained: beside an event,
//            which is left out of a prediction, and on attenuated columns even a right law may spoil.
//            Events and what runs with time are not asked (unseen_refutation.hpp), nor is the last name: of that the
//            whole prediction decides
// Threads    as the stages
// Source     as unseen_refutation.hpp

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
