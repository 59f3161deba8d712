#pragma once
// The laws that a set of servos is asked for: all of drive and gear, or those that diagnose.effects names.
//
// Names      laws of drive and gear (torquescope list laws); effects of the joint that a simulation can hold
// Errors     problems are appended (78): unknown, repeated, of the model already
// Threads    free function

#include <vector>

#include "engine/experiment/diagnose_options.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/infer/all_rows/servo_decision.hpp"

namespace torquescope {

ServoLaws servo_laws(DiagnoseOptions const& options, Regressor const& regressor, Section const& section,
                     std::vector<Problem>& problems);

}  // namespace torquescope
