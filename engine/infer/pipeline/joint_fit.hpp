#pragma once
// Least squares of a joint's parameters within the bounds of a possible joint, so that it can be simulated.
//
// Bounds     parameters of effects that cannot be negative are 0 where least squares would make them so; dry friction
//            that would drive the joint is none; an inertia that takes less than a thousandth of the torque is one that
//            takes three hundredths
// Why        missing physics bends the fitted parameters: a pendulum without its weight gets a negative inertia
// Held       bounds reached are recorded: a plain model at a bound shows a wrong sign (recording_checks.hpp)
// Threads    free function

#include <string>
#include <vector>

#include "engine/infer/pipeline/joint_bounds.hpp"
#include "engine/infer/pipeline/record_pipeline.hpp"

namespace torquescope {

// fills parameters, residual and held of a record whose columns and torque are those of the rows
// Errors     Error 65 when the rows cannot tell the parameters apart
void fit_joint(ProcessedRecord& record, JointModel const& model, std::string const& name);

}  // namespace torquescope
