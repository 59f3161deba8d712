#pragma once
// What is reported of the models before and after the search: parameters, errors, floor, noise, and how unusual the
// recording is among its twins.
//
// Threads    free functions

#include <string>

#include "engine/infer/search/selection.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// relerr on the rows, before whitening
double relative_error(ProcessedRecord const& record);

// timing: what was done to the torque channel's time (channel_timing.hpp), nothing: ""
void account_for_models(Selection const& selection, std::string const& timing, JointDiagnosis& joint);

}  // namespace torquescope
