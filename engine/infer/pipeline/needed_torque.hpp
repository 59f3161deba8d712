#pragma once
// What the motion of a recording needs by its model, where the record of the torque reached a limit.
//
// Fit        on the rows that are further from limited samples than the filter remembers: parameters that were fitted
//            to what a channel cut off would need no more than it told. Those of the record where too few rows are
//            left, or they do not tell the parameters apart
// Answer     one per sample, unit of the torque, without what effects of the torque channel add
// Threads    free function

#include <Eigen/Core>
#include <vector>

#include "engine/infer/pipeline/record_pipeline.hpp"
#include "engine/simulate/controller_fit.hpp"

namespace torquescope {

Eigen::VectorXd needed_torque(ProcessedRecord const& record, RecordPipeline const& pipeline,
                              std::vector<LimitedSample> const& limited);

}  // namespace torquescope
