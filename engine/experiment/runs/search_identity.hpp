#pragma once
// What the numbers of a population method's runs follow from, but the program: its own section of the job, every
// section that makes the data and the model, the seed, the training recordings. Not: names, the number of runs,
// [output], [diagnose], other estimators, validation recordings.
//
// Threads    free functions

#include <string>
#include <vector>

#include "engine/experiment/experiment_parts.hpp"

namespace torquescope {

// those sections but the estimator's own, with the settings that count, in the order of the job
std::vector<Section> search_sections(Job const& job);

std::string search_sha256(Experiment::Parts const& parts, EstimatorPlan const& plan);

}  // namespace torquescope
