#pragma once
// The weight of the link in the place of a spring or a cable, where it serves there as well within chance.
//
// Why        every link has a weight unless its axis is upright, few have a spring: the law that gains a little more by
//            one more parameter is no headline. It stays as a rival, so that the verdict is a class
// Rule       the weight lies in the confidence set (confidence_set.hpp) of an accepted law of the position
// Threads    as confidence_set()

#include <optional>
#include <utility>

#include "engine/infer/moving_rows/confidence_set.hpp"
#include "engine/infer/search/selection.hpp"

namespace torquescope {

struct WithWeight {
  Selection selection;  // without its stages
  ModelStage stage;
};

// selection: of the stage that `evidence` is about. Nothing where no law is accepted that it may stand for
std::optional<WithWeight> with_weight_in_place(StageSetting const& setting, Selection const& selection,
                                               Evidence const& evidence, std::span<Effect const* const> candidates,
                                               DecisionLevels const& levels, RefinementSetting const& refinement);

}  // namespace torquescope
