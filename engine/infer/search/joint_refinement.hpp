#pragma once
// The shapes of all effects of a model together, by steps along their tangents, with new replicates after each.
//
// Equation   mismatch of the stage = [model columns | tangents] * step + rest;  shapes <- shapes + their part of the
//            step, inside the bounds. The mismatch is counted from the replicates' mean, so a step of 0 means unbiased
// Stop       when every step is below half its standard deviation over replicates, or after four rounds
// Draft      rounds are made with few replicates and the levels of the first: a step in shape is no noise
// Source     indirect inference: Gourieroux, Monfort, Renault 1993, doi:10.1002/jae.3950080507

#include <optional>
#include <vector>

#include "engine/infer/search/model_stage.hpp"

namespace torquescope {

inline constexpr std::size_t draft_twins = 64;

// the stage of a model with these effects, shapes corrected, with draft_twins at most; nothing when twins run away
std::optional<ModelStage> refined_draft(StageSetting const& setting, BaselineReference const& reference,
                                        std::vector<ShapedEffect> effects);

// the same with all twins
std::optional<ModelStage> refined_stage(StageSetting const& setting, BaselineReference const& reference,
                                        std::vector<ShapedEffect> effects);

}  // namespace torquescope
