#pragma once
// The effects that a set of servos is asked for: all of drive and gear, or those that diagnose.effects names.
//
// Names      effects of drive and gear, as the program lists them; effects of the joint that a simulation can hold
// Errors     problems are appended (78): unknown, repeated, of the model already
// Threads    free function

#include <vector>

#include "engine/experiment/diagnose_options.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/infer/decision/servo_decision.hpp"

namespace torquescope {

ServoEffects servo_effects(DiagnoseOptions const& options, Regressor const& regressor, Section const& section,
                           std::vector<Problem>& problems);

}  // namespace torquescope
