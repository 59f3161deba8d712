#pragma once
// What of a model belongs to the recording it was fitted to: left out of a prediction of another one, refitted on its
// first 5 %, or, of an event, on all of it.
//
// Refits     only beyond three standard errors, neighbours of a row repeating each other (autoregression of order 1)
// Shapes     residuals, columns: rows of the validation recording; parameters: of the whole model
// Units      SI
// Threads    free functions

#include <cstdint>
#include <string>
#include <vector>

#include "engine/infer/search/model_stage.hpp"

namespace torquescope {

// the parameters a prediction begins with: those of effects that say nothing of another recording (CarryOver::none) and
// of waves per second are zero
Eigen::VectorXd transferable(ModelStage const& stage);

// phases of waves, and how far what runs with the clock had gone; record: of validation, for that model
void refit_on_head(ModelStage const& stage, ProcessedRecord const& record, Eigen::VectorXd& parameters,
                   std::vector<std::string>& nuisances);

// the stage's model as another recording has it
struct ModelElsewhere {
  JointModel model;
  Eigen::VectorXd parameters{};
};
// with events where they happen there, of their size there (search/own_event.hpp): fitted to all of its rows, since
// nothing in training says when. pipeline, record: of validation, for the stage's model
ModelElsewhere with_own_events(ModelStage const& stage, RecordPipeline const& pipeline, ProcessedRecord const& record,
                               ModelElsewhere there, std::uint64_t seed, std::vector<std::string>& nuisances);

// mean residual of the first 5 % when it is beyond chance and the joint moves both ways, else 0
double head_offset(Eigen::VectorXd const& residual, Eigen::VectorXd const& velocity);

}  // namespace torquescope
