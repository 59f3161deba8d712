#pragma once
// What of a model belongs to the recording it was fitted to: left out of a prediction of another one, or refitted on
// its first 5 %.
//
// Refits     only beyond three standard errors, neighbours of a row repeating each other (autoregression of order 1)
// Shapes     residuals, columns: rows of the validation recording; parameters: of the whole model
// Units      SI
// Threads    free functions

#include <string>
#include <vector>

#include "engine/infer/search/model_stage.hpp"

namespace torquescope {

// the parameters a prediction begins with: those of laws that say nothing of another recording (CarryOver::none) and of
// waves per second are zero, and what was done is said in `nuisances`
Eigen::VectorXd transferable(ModelStage const& stage, std::vector<std::string>& nuisances);

// phases of waves, and how far what runs with the clock had gone; record: of validation, for that model
void refit_on_head(ModelStage const& stage, ProcessedRecord const& record, Eigen::VectorXd& parameters,
                   std::vector<std::string>& nuisances);

// mean residual of the first 5 % when it is beyond chance and the joint moves both ways, else 0
double head_offset(Eigen::VectorXd const& residual, Eigen::VectorXd const& velocity);

}  // namespace torquescope
