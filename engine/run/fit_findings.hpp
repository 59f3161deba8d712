#pragma once
// What the least squares fit of a job's model says of its recordings: masses and frictions that are surely negative.
//
// Surely     more than four HAC standard errors below zero (problem/hac.hpp): 3e-5 by chance
// Fault      two and more of them are: no relation of this torque with this motion is a joint's; one is a warning
// Threads    free function

#include <vector>

#include "engine/run/experiment_parts.hpp"

namespace torquescope {

// of recordings from files; needs parts.reductions
std::vector<Finding> fit_findings(Experiment::Parts const& parts, RecordingOptions const& options);

}  // namespace torquescope
