#pragma once
// Least squares of a joint's parameters, none of them what no joint can have.
//
// Bounds     parameters of effects that cannot be negative are 0 where least squares would make them so; dry friction
//            that would drive the joint (less forwards than backwards) is none; an inertia that takes less than a share
//            of the torque (a thousandth, as a rule) is one that takes three hundredths, or that share
// Free       effects with one parameter may be left unbounded: in a fit that is a statistic, from which twins of a
//            possible joint take the bias (model_stage.hpp)
// Why        what a model lacks bends the parameters that it has: a pendulum whose weight was left out has a negative
//            inertia as soon as it swings slowly. No twin can be made of that, and what is missing could never be asked
//            for
// Held       said in the record: of a plain model it tells a torque of the wrong sign (recording_checks.hpp). Whether a
//            final model is still at a bound nobody asks
// Threads    free function

#include <string>
#include <vector>

#include "engine/pipeline/joint_bounds.hpp"
#include "engine/pipeline/record_pipeline.hpp"

namespace torquescope {

// fills parameters, residual and held of a record whose columns and torque are those of the rows; present: the columns
// that count, others have parameter 0
// Errors     Error 65 when the rows cannot tell the parameters apart
void fit_joint(ProcessedRecord& record, JointModel const& model, std::vector<Eigen::Index> const& present,
               std::string const& name, FitBounds const& bounds = {});

}  // namespace torquescope
