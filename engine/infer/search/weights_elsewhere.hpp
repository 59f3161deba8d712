#pragma once
// Weights of the rows of another recording under a model: the noise of training, on this recording's own motion.
//
// Equation   noise_weights.hpp: the noise along the rows is training's; how much a row near a reversal counts comes
//            from replicates of this recording, the walk of dry friction from its own motion and duration
// Pipeline   of this recording, weighs nothing yet; it weighs by the result from then on
// Threads    spreads replicates over the setting's workers; same bits for any number
// Source     engine/infer/moving_rows/THEORY.md, Rows and replicates

#include <memory>

#include "engine/infer/pipeline/recorded_loop.hpp"
#include "engine/infer/search/model_stage.hpp"

namespace torquescope {

// parameters: of the model there; loop: in which that recording was made, with training's levels of noise, none: its
// reversals stay masked; index: of the recording among all, 1 and up
// Errors     as the pipeline
void weigh_elsewhere(StageSetting const& setting, ModelStage const& stage, Recording const& recording,
                     Eigen::VectorXd const& parameters, RecordedLoop const* loop, std::uint32_t index,
                     RecordPipeline& pipeline);

}  // namespace torquescope
