#pragma once
// The shapes of all effects of a model together, by steps along their tangents, twins made anew after each: what a step
// of one effect's search leaves wrong in another, and the bias that processing puts on shapes, are both taken out.
//
// Equation   mismatch of the stage = [model columns | tangents] * step + rest;  shapes <- shapes + their part of the
//            step, inside the bounds; because the mismatch is counted from the twins' mean, a step of 0 means unbiased
//            shapes
// Stop       when every step is below half its standard deviation over twins, or after four rounds
// Draft      rounds are made with few twins and the levels of the first: what a step in shape changes is no noise
// Source     LESSONS items 8 and 11 of our own prototype; indirect inference: Gourieroux, Monfort, Renault 1993

#include <optional>
#include <vector>

#include "engine/search/model_stage.hpp"

namespace torquescope {

inline constexpr std::size_t draft_twins = 64;

// the stage of a model with these effects, shapes corrected, with draft_twins at most; nothing when twins run away
std::optional<ModelStage> refined_draft(StageSetting const& setting, BaselineReference const& reference,
                                        std::vector<ShapedEffect> effects);

// the same with all twins
std::optional<ModelStage> refined_stage(StageSetting const& setting, BaselineReference const& reference,
                                        std::vector<ShapedEffect> effects);

}  // namespace torquescope
